"""Drawings: flat clip-art and line sketches of trees on paper, with what is drawn around them."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Classes, Colour, Field, Floats, Image, Rng, chance, tinted
from scripts.mask_training.scenery.canvas import Canvas, Stencil
from scripts.mask_training.scenery.noise import fractal, line
from scripts.mask_training.scenery.shapes import Polygon, Shape, drawn_shape
from treefit.mask import BRANCH, FOLIAGE

LEAVES: tuple[Colour, ...] = (
    (0.10, 0.60, 0.10), (0.35, 0.70, 0.25), (0.05, 0.40, 0.15), (0.55, 0.75, 0.30), (0.25, 0.50, 0.35),
    (0.90, 0.55, 0.15), (0.80, 0.25, 0.15), (0.95, 0.80, 0.25), (0.95, 0.65, 0.75), (0.40, 0.65, 0.60),
    (0.45, 0.50, 0.20), (0.20, 0.30, 0.25),
)  # fmt: skip
WOODS: tuple[Colour, ...] = (
    (0.45, 0.28, 0.15), (0.60, 0.40, 0.25), (0.35, 0.22, 0.15), (0.50, 0.45, 0.40), (0.75, 0.60, 0.45),
    (0.15, 0.12, 0.10),
)  # fmt: skip
PAPERS: tuple[Colour, ...] = (
    (1, 1, 1),
    (1, 1, 1),
    (0.97, 0.95, 0.90),
    (0.93, 0.88, 0.76),
    (0.88, 0.92, 0.96),
    (0.80, 0.80, 0.80),
)
GROUNDS: tuple[Colour, ...] = (
    *PAPERS,
    (0.60, 0.82, 0.95),
    (0.95, 0.85, 0.65),
    (0.15, 0.18, 0.25),
    (0.85, 0.95, 0.85),
    (0.75, 0.75, 0.90),
)


def clip_art(size: int, rng: Rng) -> tuple[Image, Classes]:
    """A tree of flat or graded colours."""
    canvas = _ground(size, GROUNDS, rng)
    shape = _placed(size, rng)
    _around(canvas, shape, rng)
    outline = rng.uniform(0.003, 0.014) * size if chance(rng, 0.5) else 0.0
    ink = (0.0, 0.0, 0.0) if chance(rng, 0.5) else tinted((0.2, 0.15, 0.1), rng, 0.2)
    green = np.array(tinted(LEAVES[int(rng.integers(len(LEAVES)))], rng, 0.15))
    wood = np.array(tinted(WOODS[int(rng.integers(len(WOODS)))], rng, 0.15))
    classes = np.zeros((size, size), np.uint8)
    for polygon in shape.trunk:
        _part(canvas, classes, polygon, wood, BRANCH, outline, ink, rng)
    same = chance(rng, 0.5)
    for polygon in shape.crown:
        colour = green if same else np.clip(green * np.exp(rng.normal(0, 0.12)), 0, 1)
        _part(canvas, classes, polygon, colour, FOLIAGE, outline, ink, rng)
    for polygon in shape.limbs:
        _part(canvas, classes, polygon, wood, BRANCH, outline * 0.6, ink, rng)
    return canvas.rgb, classes


def sketch(size: int, rng: Rng) -> tuple[Image, Classes]:
    """A tree in lines on paper, hatched or not, dark on light or the reverse."""
    paper = PAPERS[int(rng.integers(len(PAPERS)))]
    ink: Colour = tinted((0.12, 0.12, 0.13), rng, 0.3)
    if chance(rng, 0.12):
        paper, ink = ink, (0.92, 0.92, 0.9)
    canvas = Canvas.blank(size)
    canvas.rgb[...] = (
        np.asarray(paper) * (1 + rng.uniform(0, 0.03) * fractal(size, size, size * 0.1, rng, 6, 0.8))[..., None]
    )
    shape = _placed(size, rng)
    width = size * rng.uniform(0.003, 0.013)
    classes = np.zeros((size, size), np.uint8)
    filled = chance(rng, 0.8)
    limbs = shape.limbs if chance(rng, 0.7) else []
    for polygons, kind in ((shape.trunk, BRANCH), (shape.crown, FOLIAGE), (limbs, BRANCH)):
        for polygon in polygons:
            inside = _inside(size, polygon)
            if filled:
                canvas.rgb[...] += (np.asarray(paper, np.float32) - canvas.rgb) * inside[..., None]
            _hatch(canvas, inside, kind, ink, width, rng)
            pen = Stencil(size)
            wobble = rng.normal(0, 0.002 * size, polygon.shape)
            pen.line(_closed(polygon + wobble), width)
            canvas.lay(ink, pen.opacity() * rng.uniform(0.7, 1.0))
            classes[inside > 0.5] = kind
    if chance(rng, 0.4):
        pen = Stencil(size)
        y = float(np.max(shape.trunk[0][:, 1])) + rng.uniform(-0.01, 0.02) * size
        left, right = np.sort(rng.uniform(0, size, 2))
        pen.line([(float(u), y + float(rng.normal(0, 0.004)) * size) for u in np.linspace(left, right, 8)], width)
        canvas.lay(ink, pen.opacity())
    return canvas.rgb, classes


def _placed(size: int, rng: Rng) -> Shape:
    height = size * rng.uniform(0.45, 0.95)
    foot = size * (0.5 + rng.uniform(-0.03, 0.03)) + height / 2
    return drawn_shape(size * rng.uniform(0.42, 0.58), min(foot, 0.98 * size), height, rng)


def _ground(size: int, kinds: tuple[Colour, ...], rng: Rng) -> Canvas:
    """A plain or graded background."""
    canvas = Canvas.blank(size)
    first = np.array(kinds[int(rng.integers(len(kinds)))], np.float32)
    second = first if chance(rng, 0.65) else np.array(kinds[int(rng.integers(len(kinds)))], np.float32)
    t = np.linspace(0, 1, size, dtype=np.float32)[:, None, None]
    canvas.rgb[...] = first + (second - first) * t
    return canvas


def _around(canvas: Canvas, shape: Shape, rng: Rng) -> None:
    """Ground, hills, a disc of shadow, sun and clouds: all background."""
    size = canvas.size
    foot, x = float(np.max(shape.trunk[0][:, 1])), float(shape.trunk[0][:, 0].mean())
    if chance(rng, 0.3):
        edge = foot - size * rng.uniform(0.0, 0.12) + line(size, size * rng.uniform(0.3, 2), rng, 2) * size * 0.02
        rows = np.arange(size, dtype=np.float32)[:, None]
        canvas.lay(tinted(LEAVES[int(rng.integers(5))], rng, 0.2), np.clip(rows - edge[None], 0, 1))
    if chance(rng, 0.35):
        pen = Stencil(size)
        pen.oval(x + rng.normal(0, 0.03) * size, foot, size * rng.uniform(0.06, 0.3), size * rng.uniform(0.01, 0.05))
        colour = ((0.3, 0.3, 0.3), (0.45, 0.3, 0.2), (0.3, 0.55, 0.2), (0.6, 0.6, 0.6))[int(rng.integers(4))]
        canvas.lay(tinted(colour, rng, 0.2), pen.opacity() * rng.uniform(0.4, 1.0))
    for share, colour in ((0.12, (1.0, 0.9, 0.4)), (0.2, (0.96, 0.97, 1.0))):
        if chance(rng, share):
            pen = Stencil(size)
            at = rng.uniform(0, size, 2) * np.array([1, 0.35])
            for _ in range(int(rng.integers(1, 5))):
                pen.oval(
                    at[0] + rng.normal(0, 0.05) * size,
                    at[1],
                    size * rng.uniform(0.03, 0.09),
                    size * rng.uniform(0.02, 0.06),
                )
            canvas.lay(colour, pen.opacity())


def _part(
    canvas: Canvas, classes: Classes, polygon: Polygon, colour: Floats, kind: int, outline: float, ink: Colour, rng: Rng
) -> None:
    """Fill one part, shade it in the manner of clip-art, and draw its outline."""
    size = canvas.size
    inside = _inside(size, polygon)
    style = int(rng.integers(5))
    fill = np.broadcast_to(colour.astype(np.float32), (size, size, 3))
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    if style == 1:  # graded
        axis = int(rng.integers(2))
        t = np.clip((np.arange(size) - low[axis]) / max(high[axis] - low[axis], 1), 0, 1) - 0.5
        tone = 1 + rng.uniform(-1, 1) * (t[:, None] if axis else t[None])
        fill = np.clip(fill * tone[..., None], 0, 1).astype(np.float32)
    elif style == 2:  # a wash or chalk
        fill = np.clip(fill * (1 + rng.uniform(0.05, 0.2) * fractal(size, size, size * 0.08, rng, 5))[..., None], 0, 1)
    canvas.lay(fill, inside)
    if style in (3, 4):  # light on one side, dark on the other
        middle = (low + high) / 2
        shift = (high - low) * np.array([rng.choice([-0.12, 0.12]), -0.12])
        other = _inside(size, (polygon - middle) * rng.uniform(0.6, 0.9) + middle + shift)
        lit = other * inside if style == 3 else inside * (1 - other)
        canvas.lay(tuple(np.clip(colour * (1.25 if style == 3 else 0.75), 0, 1)), lit)
    classes[inside > 0.5] = kind
    if outline > 0:
        pen = Stencil(size)
        pen.line(_closed(polygon), outline)
        canvas.lay(ink, pen.opacity())
        classes[pen.opacity() > 0.5] = kind


def _hatch(canvas: Canvas, inside: Field, kind: int, ink: Colour, width: float, rng: Rng) -> None:
    """Lines or dabs within a part of a sketch."""
    size = canvas.size
    style = int(rng.integers(4))
    if style == 0:
        return
    strength = rng.uniform(0.2, 0.8)
    if style == 1:  # hatching
        y, x = np.mgrid[:size, :size].astype(np.float32)
        turn, gap = (rng.uniform(0, np.pi) if kind == FOLIAGE else rng.normal(0, 0.15)), size * rng.uniform(0.012, 0.04)
        wave = (x * np.cos(turn) + y * np.sin(turn)) / gap + 0.3 * fractal(size, size, size * 0.2, rng, 2)
        shade = fractal(size, size, size * 0.25, rng, 2) > rng.uniform(-1.5, 0.5)
        canvas.lay(ink, inside * np.clip(1.5 - np.abs(wave % 1 - 0.5) * gap / width * 2, 0, 1) * shade * strength)
        return
    count = int(rng.integers(20, 400))
    long = size * rng.uniform(0.006, 0.02)
    drawn = Canvas(np.dstack([canvas.rgb, np.zeros_like(inside)]))
    half = np.stack([np.full(count, long), np.full(count, width * 0.4)], axis=1)
    turns = rng.uniform(0, np.pi, count) if kind == FOLIAGE else rng.normal(np.pi / 2, 0.2, count)
    drawn.dabs(rng.uniform(0, size, (count, 2)), half, turns, np.tile(np.asarray(ink), (count, 1)))
    canvas.rgb[...] += (drawn.rgb - canvas.rgb) * (inside * strength)[..., None]


def _inside(size: int, polygon: Polygon) -> Field:
    pen = Stencil(size)
    pen.polygon(polygon)
    return pen.opacity()


def _closed(polygon: Polygon) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in (*polygon, polygon[0])]
