"""Clumps: broad crowns of many leaves in clumps at the ends of limbs, as they are seen from across a street."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Floats, Rng, chance
from scripts.mask_training.scenery.habits import Habit, drawn_habit
from scripts.mask_training.scenery.model import Model, unit

BENDS = 4
"""Segments of a limb."""


def clumped(rng: Rng, leaves: int) -> Model:
    """A broadleaf tree with about `leaves` leaves, of a habit of chance."""
    habit = drawn_habit(rng)
    bare, half = rng.uniform(*habit.bare), rng.uniform(*habit.half_width)
    centre, radius = _clumps(habit, bare, half, rng)
    place, axis, normal = _leaves(centre, radius, rng.uniform(*habit.stretch), leaves, rng)
    # leaves that are too small for their count leave only specks
    least = np.sqrt(rng.uniform(0.8, 2.0) * 1.6 * half * (1 - bare) / (0.5 * leaves))
    long = max(least, np.exp(rng.uniform(np.log(0.0045), np.log(0.018)))) * np.exp(rng.normal(0, 0.3, (len(place), 1)))
    size = np.hstack([long, long * rng.uniform(0.45, 0.9)]).astype(np.float32)
    start, end, first, last = _wood(habit, bare, centre, rng)
    top = float(place[:, 2].max())
    lengths = (start, end, first, last, place, size)
    start, end, first, last, place, size = (np.asarray(length / top, np.float32) for length in lengths)
    return Model(start, end, first, last, place, axis, normal, size)


def _clumps(habit: Habit, bare: float, half: float, rng: Rng) -> tuple[Floats, Floats]:
    """Middles (m, 3) and radii (m,) of the clumps."""
    count = int(rng.integers(*habit.clumps)) * 3
    t = rng.uniform(0.02, 0.98, count)
    width = half * np.nan_to_num(habit.outline(t))
    keep = rng.random(count) < width / half + 0.1
    t, width = t[keep][: count // 3], width[keep][: count // 3]
    turn = rng.uniform(0, 2 * np.pi, len(t))
    lobes = sum(np.sin(k * turn + rng.uniform(0, 7)) * rng.uniform(0, 0.22) for k in (1, 2, 3))
    waves = sum(np.sin(k * 6.3 * t + turn + rng.uniform(0, 7)) * rng.uniform(0, 0.12) for k in (1, 2))
    radius = half * rng.uniform(*habit.clump) * np.exp(rng.normal(0, 0.3, len(t)))
    radius = np.minimum(radius, 0.35 * (1 - bare))
    out = np.maximum(width * (1 + lobes + waves) - 0.7 * radius, 0) * rng.random(len(t)) ** rng.uniform(0.25, 0.55)
    height = bare + (1 - bare) * t
    height = np.clip(height, bare + 0.5 * radius, 1 - 0.4 * radius)
    middle = np.stack([out * np.cos(turn), out * np.sin(turn), height], axis=1)
    return middle.astype(np.float32), radius.astype(np.float32)


def _leaves(centre: Floats, radius: Floats, stretch: float, leaves: int, rng: Rng) -> tuple[Floats, Floats, Floats]:
    """Place, axis and normal (k, 3) of leaves, most near the surface of their clump."""
    share = radius**2 / (radius**2).sum()
    rows = np.repeat(np.arange(len(radius)), np.maximum(1, np.round(share * leaves).astype(int)))
    out = unit(rng.standard_normal((len(rows), 3), dtype=np.float32))
    far = rng.random((len(rows), 1), dtype=np.float32) ** np.float32(rng.uniform(0.35, 0.8))
    # clumps are no balls: each is wavy around its own middle
    wavy = 1 + 0.3 * np.sin(3 * out + rng.uniform(0, 7, (len(radius), 3)).astype(np.float32)[rows])
    away = out * far * wavy * np.array([1, 1, stretch], np.float32)
    away[:, 2] -= rng.uniform(0, 0.5) * (away[:, :2] ** 2).sum(axis=1)  # weight bends the sides down
    place = centre[rows] + away * radius[rows, None]
    normal = unit(out + rng.standard_normal(out.shape, dtype=np.float32) * np.float32(rng.uniform(0.12, 0.8)))
    axis = unit(np.cross(normal, rng.standard_normal(out.shape, dtype=np.float32)))
    return place, axis.astype(np.float32), normal


def _wood(habit: Habit, bare: float, centre: Floats, rng: Rng) -> tuple[Floats, Floats, Floats, Floats]:
    """Stems: a trunk, leaders that it parts into, and a limb to each clump."""
    girth = rng.uniform(*habit.girth) * np.exp(rng.normal(0, 0.15))
    count = int(rng.integers(habit.leaders[0], habit.leaders[1] + 1))
    fork = np.array([rng.normal(0, 0.015), rng.normal(0, 0.015), rng.uniform(0.6, 1.15) * max(bare, 0.02)])
    if bare < 0.1 or chance(rng, 0.1):
        fork = np.array([0, 0, rng.uniform(0.0, 0.05)])  # several stems from the ground
    middle = centre.mean(axis=0)
    paths, firsts, lasts = [], [], []
    if fork[2] > 0.02:
        flare = girth * rng.uniform(1.1, 1.5)
        foot = np.array([[0, 0, -0.004], [0, 0, 0.02]])
        paths += [_bent(foot[0], foot[1], 0, rng), _bent(foot[1], fork, 0.03, rng)]
        firsts += [flare * 1.15, flare]
        lasts += [flare, girth * rng.uniform(0.75, 0.95)]
    leaders = []
    for index in range(count):
        turn = 2 * np.pi * (index + rng.random()) / count
        lean = np.array([np.cos(turn), np.sin(turn), 0]) * (0 if count == 1 else rng.uniform(0.25, 0.7))
        reach = np.ptp(centre[:, :2], axis=0).max() / 2
        end = np.array([middle[0], middle[1], bare + (1 - bare) * rng.uniform(0.6, 0.9)]) + lean * reach
        leaders.append(_bent(fork, end, 0.06, rng))
        paths.append(leaders[-1])
        firsts.append(girth * (0.8 if count == 1 else rng.uniform(0.5, 0.8)))
        lasts.append(girth * 0.12)
    joints = np.concatenate(leaders)
    thick = np.concatenate([np.linspace(f, g, BENDS + 1) for f, g in zip(firsts[-count:], lasts[-count:], strict=True)])
    for clump in centre:
        away = np.linalg.norm(joints[:, :2] - clump[:2], axis=1) + 1.6 * np.abs(joints[:, 2] - clump[2] + 0.12)
        joint = int(away.argmin())
        paths.append(_bent(joints[joint], clump, 0.08, rng))
        firsts.append(thick[joint] * rng.uniform(0.3, 0.65))
        lasts.append(girth * 0.05)
    start = np.concatenate([path[:-1] for path in paths])
    end = np.concatenate([path[1:] for path in paths])
    widths = [np.linspace(f, g, BENDS + 1) for f, g in zip(firsts, lasts, strict=True)]
    return start, end, np.concatenate([w[:-1] for w in widths]), np.concatenate([w[1:] for w in widths])


def _bent(start: Floats, end: Floats, bend: float, rng: Rng) -> Floats:
    """Points (BENDS + 1, 3) of a curve that is bent by `bend` of its length to a side of chance, and upwards."""
    t = np.linspace(0, 1, BENDS + 1)[:, None]
    long = float(np.linalg.norm(end - start))
    side = rng.normal(0, bend * long, 3) + np.array([0, 0, -0.5 * bend * long])
    path: Floats = (
        start + (end - start) * t + side * 4 * t * (1 - t) + rng.normal(0, 0.2 * bend * long, t.shape) * t * (1 - t)
    )
    return path
