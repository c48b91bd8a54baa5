"""A small procedural tree for the tests of files and pictures."""

import numpy as np
import pytest

from treefit.plant import Plant, check_plant


def make_tree(seed: int = 0, branches: int = 36, twigs: int = 10, leaves: int = 5000) -> Plant:
    """Return a broad tree of about 8 m: a trunk, limbs, branches and twigs; leaves on the twigs."""
    rng = np.random.default_rng(seed)
    trunk = _trunk(rng)
    stems = [trunk]
    count = len(trunk["position"])
    limbs = _sprout(rng, trunk, 0, np.linspace(0.28, 0.98, branches), 1, 7, 3.2, count)
    stems.append(limbs)
    count += len(limbs["radius"])
    start = count - len(limbs["radius"])
    twig_seats = np.sort(rng.uniform(0, 1, branches * twigs))
    stems.append(_sprout(rng, limbs, start, twig_seats, 2, 4, 1.1, count))
    graph = {key: np.concatenate([stem[key] for stem in stems]) for key in trunk}
    foot = len(graph["radius"]) - len(stems[-1]["radius"])
    seat = rng.integers(foot, len(graph["radius"]), leaves)
    axis = _unit(rng.normal((0, 0, -0.2), size=(leaves, 3)))
    normal = _unit(np.cross(axis, np.cross(rng.normal(size=(leaves, 3)) * 0.6 + [0, 0, 1], axis)))
    length = rng.uniform(0.10, 0.18, leaves)
    plant = Plant(
        graph["position"].astype(np.float32), graph["radius"].astype(np.float32),
        graph["parent"].astype(np.int32), graph["level"].astype(np.int32),
        (graph["position"][seat] + rng.normal(scale=0.06, size=(leaves, 3))).astype(np.float32),
        axis.astype(np.float32), normal.astype(np.float32),
        np.column_stack([length, 0.6 * length]).astype(np.float32),
    )  # fmt: skip
    check_plant(plant)
    return plant


def _trunk(rng, n=28, height=7.0):
    t = np.linspace(0, 1, n)
    sway = 0.12 * np.cumsum(rng.normal(size=(n, 2)), axis=0) * t[:, None]
    position = np.column_stack([sway, height * t])
    return {
        "position": position, "radius": 0.22 * (1 - t) ** 0.8 + 0.008,
        "parent": np.arange(n) - 1, "level": np.zeros(n, int),
    }  # fmt: skip


def _sprout(rng, host, host_start, seats, level, n, reach, first):
    """Stems of `n` vertices at the relative `seats` of the vertices of `host`."""
    m = len(seats)
    seat = np.clip((seats * (len(host["radius"]) - 1)).astype(int), 1, None)
    height = (host["position"][seat, 2] / 7.0).clip(0, 1)
    turn = np.arange(m) * 2.4 + rng.normal(scale=0.3, size=m)
    rise = 0.25 + 0.9 * height + rng.normal(scale=0.15, size=m)
    direction = np.column_stack([np.cos(turn) * np.cos(rise), np.sin(turn) * np.cos(rise), np.sin(rise)])
    reach = reach * (1.05 - 0.6 * height) * rng.uniform(0.7, 1.1, m)
    steps = np.arange(1, n + 1) / n
    position = host["position"][seat][:, None] + direction[:, None] * (reach[:, None] * steps)[..., None]
    position = position + 0.04 * np.cumsum(rng.normal(size=(m, n, 3)), axis=1)
    position[..., 2] += 0.25 * reach[:, None] * steps**2
    radius = np.minimum(0.6 * host["radius"][seat], 0.03 * reach)[:, None] * (1 - 0.85 * steps)
    parent = first + np.arange(m * n).reshape(m, n) - 1
    parent[:, 0] = host_start + seat
    return {
        "position": position.reshape(-1, 3), "radius": radius.ravel(),
        "parent": parent.ravel(), "level": np.full(m * n, level),
    }  # fmt: skip


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


@pytest.fixture(scope="session")
def tree() -> Plant:
    return make_tree()
