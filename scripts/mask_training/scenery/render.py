"""Render: a model under light becomes a layer of a picture, with what is wood and what is leaf in every pixel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scripts.mask_training.scenery.arrays import Field, Floats, Image, Rng
from scripts.mask_training.scenery.light import Light, depth_of_leaves
from scripts.mask_training.scenery.model import Model
from scripts.mask_training.scenery.palettes import Bark
from scripts.mask_training.scenery.splats import draw_leaves, draw_stems, shrink

GAMMA = 2.2
LEAST_BRANCH = 0.0085
"""Width of a stem in sizes of the picture from which a person calls it a branch and not a part of the crown."""


@dataclass(frozen=True)
class Pose:
    """Where the tree stands: column and row of its foot, height in pixels; angles in radians."""

    x: float
    y: float
    height: float
    turn: float
    pitch: float = 0.0
    lean: float = 0.0
    aspect: float = 1.0


@dataclass(frozen=True, eq=False)
class Look:
    """Colours of the leaves (m, 3), how much they differ, bark, share of leaves under snow, leaf outline 1 or 2."""

    palette: Floats
    spread: float
    bark: Bark
    snow: float = 0.0
    square: float = 2.0


@dataclass(frozen=True, eq=False)
class Layer:
    """Colour (h, w, 3) and shares (h, w) of wood, leaves and twigs."""

    rgb: Image
    wood: Field
    leaf: Field
    twig: Field

    @property
    def cover(self) -> Field:
        """Share of each pixel that the tree covers."""
        total: Field = self.wood + self.leaf + self.twig
        return total


def render(model: Model, pose: Pose, look: Look, light: Light, size: int, fine: int, rng: Rng) -> Layer:
    """Layer of size x size pixels, drawn `fine` times larger."""
    side = size * fine
    rgb = np.zeros((side, side, 3), np.float32)
    depth, kind = np.full((side, side), np.inf, np.float32), np.zeros((side, side), np.uint8)
    leaf, normal, axis = (_turned(part, pose) for part in (model.leaf_place, model.leaf_normal, model.leaf_axis))
    start, end = _turned(model.stem_from, pose), _turned(model.stem_to, pose)
    area = model.leaf_size.prod(axis=1) * 0.4
    sun = np.array(light.sun, np.float32)
    scale = pose.height * fine
    origin = np.array([pose.x * fine, pose.y * fine, 0], np.float32)
    gain = 1.0
    if len(leaf):
        colour, gain = _leaf_colours(leaf, normal, area, look, light, rng)
        across = np.cross(normal, axis)
        along, across = (
            np.stack([v[:, 0] * pose.aspect, -v[:, 2]], axis=1) * (model.leaf_size[:, k : k + 1] * 0.5 * scale)
            for k, v in enumerate((axis, across))
        )
        # leaves seen edge-on still have a little width
        across += along[:, ::-1] * np.array([0.12, -0.12], np.float32)
        draw_leaves(_screen(leaf, scale, pose.aspect) + origin, along, across, colour, look.square, rgb, depth, kind)
    else:
        gain = _bare_gain(light)
    keep = (model.radius_from + model.radius_to) * scale > (0.12 if len(leaf) == 0 else 0.4)
    start, end = start[keep], end[keep]
    radius = np.stack([model.radius_from[keep], model.radius_to[keep]], axis=1) * scale
    ends = np.hstack(
        [
            _screen(start, scale, pose.aspect) + origin,
            radius[:, :1],
            _screen(end, scale, pose.aspect) + origin,
            radius[:, 1:],
        ]
    )
    share = np.hstack([_stem_light(leaf, area, start, sun), _stem_light(leaf, area, end, sun)])
    twig = (radius.sum(axis=1) < LEAST_BRANCH * side).astype(np.uint8)
    bark = _bark(look.bark, light, gain, scale, rng)
    towards = np.array([sun[0], sun[2], -sun[1]], np.float32)
    draw_stems(np.ascontiguousarray(ends, np.float32), share, twig, bark, towards, rgb, depth, kind)
    if look.snow > 0 and len(ends):
        caps = ends.astype(np.float32)
        caps[:, [1, 5]] -= 0.7 * caps[:, [3, 7]]
        caps[:, [2, 6]] -= caps[:, [3, 7]]
        caps[:, [3, 7]] *= 0.7
        flat = np.abs(caps[:, 5] - caps[:, 1]) < 1.5 * np.abs(caps[:, 4] - caps[:, 0])
        flat &= rng.random(len(caps)) < look.snow
        white = bark.copy()
        white[:6], white[6], white[8] = 0.85, 0.1, 0.0
        draw_stems(caps[flat], share[flat], twig[flat], white, towards, rgb, depth, kind)
    return Layer(*shrink(rgb, kind, fine))


def opened(model: Model, pose: Pose, rng: Rng) -> Model:
    """`model` without most of the leaves before its trunk, as many old trees show their limbs to the viewer."""
    if model.n_leaves == 0:
        return model
    leaf = _turned(model.leaf_place, pose)
    low = float(np.quantile(leaf[:, 2], 0.02))
    top = low + rng.uniform(0.15, 0.55) * (1 - low)
    wide = rng.uniform(0.03, 0.2) * np.clip((top - leaf[:, 2]) / max(top - low, 0.01), 0, 1) ** 0.5
    gone = (np.abs(leaf[:, 0]) < wide) & (leaf[:, 1] < 0.05) & (rng.random(len(leaf)) < rng.uniform(0.6, 1.0))
    return replace(
        model, leaf_place=model.leaf_place[~gone], leaf_axis=model.leaf_axis[~gone],
        leaf_normal=model.leaf_normal[~gone], leaf_size=model.leaf_size[~gone],
    )  # fmt: skip


def _turned(vectors: Floats, pose: Pose) -> Floats:
    """`vectors` (n, 3) as the viewer has them: right, away, up."""
    ca, sa, cp, sp = np.cos(pose.turn), np.sin(pose.turn), np.cos(pose.pitch), np.sin(pose.pitch)
    cl, sl = np.cos(pose.lean), np.sin(pose.lean)
    around = np.array([[ca, -sa, 0], [sa, ca, 0], [0, 0, 1]])
    tilted = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    leaning = np.array([[cl, 0, sl], [0, 1, 0], [-sl, 0, cl]])
    turned: Floats = vectors @ (leaning @ tilted @ around).T.astype(np.float32)
    return turned


def _screen(places: Floats, scale: float, aspect: float) -> Floats:
    seen: Floats = places[:, [0, 2, 1]] * np.array([scale * aspect, -scale, scale], np.float32)
    return seen


def _leaf_colours(
    leaf: Floats, normal: Floats, area: Floats, look: Look, light: Light, rng: Rng
) -> tuple[Floats, float]:
    """Display colours (k, 3) of leaves, and the factor from linear light to the exposure of the picture."""
    sun = np.array(light.sun, np.float32)
    open_sun = np.exp(-0.9 * depth_of_leaves(leaf, area, leaf, sun))
    sides = (np.array(d, np.float32) for d in ((0.0, -0.25, 1.0), (0.7, -0.5, 0.5), (-0.7, -0.5, 0.5)))
    weight = (0.5, 0.25, 0.25)
    open_sky = sum(w * np.exp(-0.8 * depth_of_leaves(leaf, area, leaf, d)) for w, d in zip(weight, sides, strict=True))
    albedo = _albedo(leaf, open_sky, look, rng)
    facing = normal @ sun
    through = (facing * normal[:, 1] > 0)[:, None]  # lit from behind as the viewer sees it
    direct = (0.25 + 0.75 * np.abs(facing)) * open_sun * light.strength
    seen = np.where(through, albedo * np.array([0.95, 1.0, 0.35], np.float32), albedo)
    gloss = 0.05 * np.abs(facing)[:, None] ** 8 * ~through
    upward = 0.75 + 0.25 * np.abs(normal[:, 2])
    sky = (0.12 + 0.88 * open_sky) * upward
    linear = (seen + gloss) * direct[:, None] * np.array(light.sun_colour, np.float32) * 2.2
    linear += albedo * sky[:, None] * np.array(light.sky_colour, np.float32) * (1.5 - 0.5 * light.strength)
    tones = linear @ np.array([0.3, 0.59, 0.11], np.float32)
    own = float(np.quantile(albedo @ np.array([0.3, 0.59, 0.11], np.float32), 0.5)) / 0.16
    gain = light.brightness**GAMMA * own**0.6 / max(float(np.quantile(tones, 0.85)), 1e-4)
    return np.minimum(linear * gain, 1.0) ** np.float32(1 / GAMMA), gain


def _albedo(leaf: Floats, open_sky: Floats, look: Look, rng: Rng) -> Floats:
    """Linear colours (k, 3): mixed by place in the crown and by chance."""
    palette = look.palette**GAMMA
    count = len(palette)
    waves = np.zeros(len(leaf), np.float32)
    for _ in range(3):
        direction = rng.normal(0, 1, 3) * rng.uniform(2, 14)
        waves += np.sin(leaf @ direction.astype(np.float32) + np.float32(rng.uniform(0, 7)))
    mix = (
        0.5
        + 0.16 * waves
        + 0.22 * rng.standard_normal(len(leaf), dtype=np.float32)
        + rng.uniform(0, 0.4) * (open_sky - 0.5)
    )
    at = np.clip(mix, 0, 0.999) * (count - 1)
    low = at.astype(int)
    part = (at - low)[:, None]
    high = np.minimum(low + 1, count - 1)
    albedo = palette[low] * (1 - part) + palette[high] * part
    albedo *= np.exp(look.spread * rng.standard_normal((len(leaf), 1), dtype=np.float32))
    if look.snow > 0:
        white = (open_sky > 0.45) & (rng.random(len(leaf)) < look.snow)
        albedo[white] = (0.82, 0.85, 0.9)
    coloured: Floats = albedo.astype(np.float32)
    return coloured


def _bare_gain(light: Light) -> float:
    return float(light.brightness**GAMMA / 0.35)


def _stem_light(leaf: Floats, area: Floats, places: Floats, sun: Floats) -> Floats:
    """Shares (n, 2) of the light of sun and sky that reach stems at `places` (n, 3)."""
    if len(leaf) == 0 or len(places) == 0:
        return np.ones((len(places), 2), np.float32)
    open_sun = np.exp(-0.9 * depth_of_leaves(leaf, area, places, sun))
    open_sky = np.exp(-0.7 * depth_of_leaves(leaf, area, places, np.array([0.0, -0.9, 0.6], np.float32)))
    share: Floats = np.stack([open_sun, 0.2 + 0.8 * open_sky], axis=1).astype(np.float32)
    return share


def _bark(bark: Bark, light: Light, gain: float, scale: float, rng: Rng) -> Floats:
    """The numbers that draw_stems takes."""
    first, second = np.array(bark.light) ** GAMMA, np.array(bark.dark) ** GAMMA
    tint = np.array(light.sun_colour) * gain
    strength = 2.2 * light.strength
    return np.array(
        [*(first * tint), *(second * tint), bark.rough, scale * rng.uniform(0.004, 0.012), bark.marks,
         rng.integers(1000), strength, 1.5 - 0.5 * light.strength],
        np.float32,
    )  # fmt: skip
