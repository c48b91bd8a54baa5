"""Studies: a rendered tree as no photograph shows it: cut out, as a silhouette, drawn with ink, washed, painted."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter

from scripts.mask_training.scenery.arrays import Classes, Colour, Field, Image, Rng, blend, chance, smoothstep, tinted
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.labels import person_labels
from scripts.mask_training.scenery.light import sunlight
from scripts.mask_training.scenery.noise import fractal, line
from scripts.mask_training.scenery.render import Layer, Pose, render
from scripts.mask_training.scenery.setting import drawn_setting
from scripts.mask_training.scenery.sky import paint_sky
from scripts.mask_training.scenery.trees import drawn_kind, drawn_tree, slender

LEAVES = 16_000


def cut_out(size: int, rng: Rng) -> tuple[Image, Classes]:
    """A lit tree on a plain ground, now and then with a disc of shadow."""
    layer, classes, pose = _rendered(size, rng)
    canvas = _plain(size, rng, light=0.8)
    if chance(rng, 0.35):
        _disc(canvas, pose, rng)
    blend(canvas.rgb, layer.rgb, layer.cover)
    return canvas.rgb, classes


def silhouette(size: int, rng: Rng) -> tuple[Image, Classes]:
    """A tree in one dark colour on a plain, graded or evening ground."""
    layer, classes, pose = _rendered(size, rng)
    ink: Colour = tinted((0.05, 0.05, 0.06), rng, 0.5)
    if chance(rng, 0.25):
        ink = tuple(rng.uniform(0.0, 0.6, 3))
    if chance(rng, 0.45):
        canvas = Canvas.blank(size)
        paint_sky(canvas, drawn_setting("green", size, rng), rng)
        if chance(rng, 0.7):
            edge = pose.y - rng.uniform(0, 0.02) * size + line(size, size * 0.3, rng, 4) * size * 0.006
            canvas.lay(ink, np.clip(np.arange(size, dtype=np.float32)[:, None] - edge[None], 0, 1))
            classes[canvas.land > 0.5] = 0
    else:
        canvas = _plain(size, rng, light=0.9)
    if chance(rng, 0.2):
        _disc(canvas, pose, rng, ink)
        classes[canvas.land > 0.9] = 0
    blend(canvas.rgb, ink, smoothstep(layer.cover, 0.1, 0.7))
    return canvas.rgb, classes


def ink_drawing(size: int, rng: Rng) -> tuple[Image, Classes]:
    """A tree with all its leaves as a pencil or a pen draws it: edges of light and shade on paper."""
    layer, classes, _ = _rendered(size, rng)
    canvas = _plain(size, rng, light=1.0)
    grey = layer.rgb.mean(axis=2) * layer.cover + (1 - layer.cover)
    edges = np.abs(gaussian_filter(grey, size * 0.003) - gaussian_filter(grey, size * rng.uniform(0.006, 0.012)))
    outline = np.hypot(*np.gradient(gaussian_filter(layer.cover, size * 0.004)))
    shade = (1 - grey) * layer.cover * rng.uniform(0, 0.6)
    grain = 1 + 0.35 * fractal(size, size, 3, rng, 2, 0.9)
    strength = edges * rng.uniform(3, 12) + outline * rng.uniform(0.5, 3) + shade
    blend(canvas.rgb, tinted((0.15, 0.15, 0.16), rng, 0.3), np.clip(strength * grain, 0, 0.95).astype(np.float32))
    return canvas.rgb, classes


def wash(size: int, rng: Rng) -> tuple[Image, Classes]:
    """A tree in watercolours: few tones, soft edges that dry darker, colours that run."""
    layer, classes, pose = _rendered(size, rng)
    canvas = _plain(size, rng, light=1.0)
    for _ in range(int(rng.integers(0, 4))):  # sky and ground as large stains
        stain = smoothstep(fractal(size, size, size * 0.5, rng, 4, 0.5, 2.0), rng.uniform(-0.5, 1), 1.6)
        below = np.arange(size)[:, None] > pose.y - rng.uniform(0, 0.1) * size
        colour = tinted((0.45, 0.62, 0.30) if chance(rng, 0.5) else (0.55, 0.72, 0.90), rng, 0.2)
        blend(
            canvas.rgb,
            colour,
            (stain * (below if colour[1] > colour[2] else ~below) * rng.uniform(0.3, 0.8)).astype(np.float32),
        )
    cover = np.clip(gaussian_filter(layer.cover, size * rng.uniform(0.003, 0.009)), 0, 1)
    soft = gaussian_filter(layer.rgb * layer.cover[..., None], (size * 0.008, size * 0.008, 0))
    soft /= np.maximum(gaussian_filter(layer.cover, size * 0.008), 0.05)[..., None]
    soft = np.round(np.clip(soft * rng.uniform(1.0, 1.6), 0, 1) * rng.integers(3, 9)) / 8 if chance(rng, 0.4) else soft
    opacity = smoothstep(cover, 0.15, 0.55)
    rim = np.clip(opacity * (1 - smoothstep(cover, 0.5, 0.95)), 0, 1)
    runs = np.clip(0.8 + 0.18 * fractal(size, size, size * 0.12, rng, 4), 0.3, 1)
    blend(canvas.rgb, np.clip(soft, 0, 1).astype(np.float32), opacity * runs)
    canvas.tone(1 - 0.3 * rim)
    return np.clip(canvas.rgb, 0, 1), classes


def brushed(picture: Image, rng: Rng) -> Image:
    """`picture` (h, w, 3) painted anew with strokes of a brush."""
    size = len(picture)
    canvas = Canvas(
        np.dstack([gaussian_filter(picture, (size * 0.02, size * 0.02, 0)), np.zeros(picture.shape[:2], np.float32)])
    )
    for share in (0.022, 0.012, 0.007):
        wide = size * share * rng.uniform(0.7, 1.2)
        count = min(int(1.6 * size * size / (wide * wide * 4)), 5000)
        place = rng.uniform(0, size, (count, 2))
        at = place[:, 1].astype(int), place[:, 0].astype(int)
        colour = picture[at] * np.exp(rng.normal(0, 0.06, (count, 1)))
        half = wide * np.exp(rng.normal(0, 0.25, (count, 2))) * np.array([1.6, 0.55])
        turn = 1.5 * fractal(size, size, size * 0.3, rng, 2)[at] + rng.normal(0, 0.3, count)
        canvas.dabs(place, half, turn, np.clip(colour, 0, 1), 0.85)
    return canvas.rgb


def _rendered(size: int, rng: Rng) -> tuple[Layer, Classes, Pose]:
    """A tree alone, whole and upright, with its classes."""
    tree = drawn_tree(drawn_kind(rng), rng, LEAVES)
    height = size * rng.uniform(0.5, 0.95)
    wide = slender(tree.model)
    height = min(height, 1.05 * size / max(wide, 0.1))
    foot = min(size * (0.5 + rng.uniform(-0.02, 0.06)) + height / 2, 0.985 * size)
    pose = Pose(size * rng.uniform(0.45, 0.55), foot, height, rng.uniform(0, 2 * np.pi), 0.0, rng.normal(0, 0.02))
    light = sunlight(rng, rng.uniform(0.1, 0.9), rng.uniform(0.35, 0.65))
    layer = render(tree.model, pose, tree.look, light, size, 2, rng)
    nothing: Field = np.zeros((size, size), np.float32)
    return layer, person_labels(layer, nothing, tree.kind == "bare"), pose


def _plain(size: int, rng: Rng, light: float) -> Canvas:
    """A plain ground, white or pale in a share `light` of the draws."""
    canvas = Canvas.blank(size)
    if chance(rng, light):
        colour = np.ones(3) if chance(rng, 0.6) else rng.uniform(0.78, 1.0) * (1 + rng.normal(0, 0.04, 3))
    else:
        colour = rng.uniform(0.0, 0.9, 3) if chance(rng, 0.5) else np.full(3, rng.uniform(0, 0.5))
    ends = np.stack([colour, colour if chance(rng, 0.7) else colour * rng.uniform(0.6, 1.1)])
    t = np.linspace(0, 1, size)[:, None]
    graded = np.clip(ends[0] + (ends[1] - ends[0]) * t, 0, 1)
    paper = 1 + (rng.uniform(0, 0.03) * fractal(size, size, size * 0.05, rng, 5, 0.9) if chance(rng, 0.4) else 0.0)
    canvas.rgb[...] = np.clip(graded[:, None] * np.broadcast_to(paper, (size, size))[..., None], 0, 1)
    return canvas


def _disc(canvas: Canvas, pose: Pose, rng: Rng, colour: Colour | None = None) -> None:
    pen = Stencil(canvas.size)
    wide = pose.height * rng.uniform(0.1, 0.4)
    pen.oval(pose.x + rng.normal(0, 0.1) * wide, pose.y, wide, wide * rng.uniform(0.08, 0.25))
    soft = gaussian_filter(pen.opacity(), canvas.size * rng.uniform(0.001, 0.02))
    chosen = colour or ((0.4, 0.4, 0.4), (0.35, 0.5, 0.2), (0.45, 0.32, 0.2))[int(rng.integers(3))]
    canvas.lay(chosen, soft * (1.0 if colour else rng.uniform(0.4, 1.0)))
