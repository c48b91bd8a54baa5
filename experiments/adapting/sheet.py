"""Picture plants.png of the task adapt: random trees of the ranges, so that one sees whether they make sense."""

from __future__ import annotations

from collections.abc import Sequence

from PIL import Image

from experiments.adapting.trial import Tree
from experiments.sheet_cells import Drawing, grow
from experiments.sheet_presets import Block, preset_pages
from experiments.terminal import counted
from treefit.asset import AssetSettings
from treefit.plant import Generator, Plant
from treefit.plant.extent import extent_of

HEIGHT = 230
"""Pixels of a tree's picture."""

LEGEND = "Random genomes of the proposed ranges, each on a seed of its own and at its own scale, as they come."


def plants_sheet(generator: Generator, trees: Sequence[Tree], asset: AssetSettings, title: str) -> Image.Image:
    """Picture of `trees`, one that failed with its reason; those that grew grow once more."""
    drawing = Drawing(asset, "shaded", HEIGHT, HEIGHT)
    blocks = [_block(generator, drawing, i, tree) for i, tree in enumerate(counted(trees, "pictures"))]
    return preset_pages(blocks, drawing.sizes, title, LEGEND)[0]


def _block(generator: Generator, drawing: Drawing, number: int, tree: Tree) -> Block:
    plant = grow(generator, tree.values, tree.seed) if tree.grew else f"{tree.kind}: {tree.reason}"
    facts = ["", ""]
    if isinstance(plant, Plant):
        height = extent_of(plant).height
        facts = [f"{height:.3g} m high", f"{plant.n_vertices:,} vertices, {plant.n_leaves:,} leaves"]
    return Block(f"{number + 1}", drawing.row([plant]), [facts])
