"""Paint the example pictures of experiments/images; running it again gives the same bytes.

Usage: python scripts/make_example_images.py [--seed 0] [--folder experiments/images] [--only pine oak ...]
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from painting.broadleaf import Species, paint_broadleaf
from painting.canvas import OVERSAMPLING, blank, dab, shrunk, tone
from painting.conifer import paint_conifer
from painting.landscape import GRASS, Scene, paint, throw_shadow
from painting.pencil import draw_tree
from PIL import Image, ImageDraw

WIDTH, HEIGHT = 600, 800
COLOURS = 256

OAK = Species(
    bare=0.22, girth=0.029, middle=0.60, wide=0.43, high=0.40, lobes=64, lobe=0.098, leaves=900, leaf=0.0066,
    greens=((0.0, (18, 36, 16)), (0.4, (52, 88, 30)), (0.75, (124, 152, 54)), (1.0, (212, 216, 118))),
)  # fmt: skip
LINDEN = Species(
    bare=0.22, girth=0.024, middle=0.60, wide=0.28, high=0.40, lobes=54, lobe=0.085, leaves=800, leaf=0.0062,
    greens=((0.0, (16, 58, 30)), (0.4, (44, 116, 46)), (0.75, (110, 172, 66)), (1.0, (204, 226, 124))),
)  # fmt: skip
ELM = Species(
    bare=0.27, girth=0.030, middle=0.64, wide=0.40, high=0.35, lobes=34, lobe=0.082, leaves=420, leaf=0.0085,
    greens=OAK.greens,
)  # fmt: skip


def main() -> None:
    """Write the pictures asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--folder", type=Path, default=Path(__file__).parents[1] / "experiments" / "images")
    parser.add_argument("--only", nargs="+", choices=sorted(PICTURES), default=sorted(PICTURES))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for name in arguments.only:
        rng = np.random.default_rng([arguments.seed, *name.encode()])
        path = arguments.folder / f"{name}.png"
        PICTURES[name](rng).save(path, optimize=True)
        print(f"{path}: {path.stat().st_size // 1024} KiB")


def pine(rng: np.random.Generator) -> Image.Image:
    """A conifer on a lawn before hazy hills."""
    scene = Scene(WIDTH, HEIGHT, 0.80, 0.55, ((168, 190, 208), (146, 174, 192), (126, 156, 172)))
    land = paint(scene, rng)
    tree = blank(WIDTH, HEIGHT)
    x, foot = 0.5 * tree.width, 0.915 * tree.height
    paint_conifer(tree, x, foot, 0.86 * tree.height, rng)
    throw_shadow(land, x + 90, foot + 8, 330, 38, rng)
    return finished(land, tree, x, foot, rng)


def oak(rng: np.random.Generator) -> Image.Image:
    """A broad deciduous tree on a meadow under summer clouds."""
    scene = Scene(WIDTH, HEIGHT, 0.78, 0.75, ((172, 192, 210), (150, 176, 190), (132, 160, 170)))
    land = paint(scene, rng)
    tree = blank(WIDTH, HEIGHT)
    x, foot = 0.5 * tree.width, 0.90 * tree.height
    paint_broadleaf(tree, OAK, x, foot, 0.84 * tree.height, rng)
    throw_shadow(land, x + 80, foot + 10, 440, 46, rng)
    return finished(land, tree, x, foot, rng)


def cutout(rng: np.random.Generator) -> Image.Image:
    """A tree with a transparent background."""
    tree = blank(WIDTH, HEIGHT)
    paint_broadleaf(tree, LINDEN, 0.5 * tree.width, 0.96 * tree.height, 0.90 * tree.height, rng)
    return shrunk(tree).quantize(COLOURS, Image.Quantize.FASTOCTREE)


def silhouette(rng: np.random.Generator) -> Image.Image:
    """A black tree on white."""
    tree = blank(WIDTH, HEIGHT)
    paint_broadleaf(tree, ELM, 0.5 * tree.width, 0.95 * tree.height, 0.84 * tree.height, rng)
    shape = shrunk(tree).getchannel("A")
    return shape.point(lambda opacity: 255 - opacity).quantize(16)


def sketch(rng: np.random.Generator) -> Image.Image:
    """A pencil drawing of a tree."""
    return shrunk(draw_tree(WIDTH, HEIGHT, rng)).convert("L").quantize(48)


def finished(land: Image.Image, tree: Image.Image, x: float, foot: float, rng: np.random.Generator) -> Image.Image:
    """The tree set into the land, grass over its foot, shrunk and in few colours to keep the file small."""
    land.paste(tree, (0, 0), tree)
    draw = ImageDraw.Draw(land)
    for _ in range(90):
        u, long = x + rng.normal(0, 42), rng.uniform(10, 24)
        colour = tone(GRASS, rng.uniform(0.15, 0.6), rng, 0.06)
        dab(draw, u, foot + rng.uniform(0, 14) - long / 2, long, 3, np.pi / 2 + rng.normal(0, 0.3), colour)
    small = land.resize((land.width // OVERSAMPLING, land.height // OVERSAMPLING), Image.Resampling.LANCZOS)
    # a little grain, as film has, hides the steps between few colours
    grain = rng.normal(0, 1.3, (small.height, small.width, 1))
    small = Image.fromarray(np.clip(np.asarray(small) + grain, 0, 255).round().astype(np.uint8))
    palette = small.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, kmeans=2)
    return small.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)


PICTURES: dict[str, Callable[[np.random.Generator], Image.Image]] = {
    "pine": pine,
    "oak": oak,
    "cutout": cutout,
    "silhouette": silhouette,
    "sketch": sketch,
}

if __name__ == "__main__":
    main()
