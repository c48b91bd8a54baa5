"""Targets of the task compare: pictures, and plants of the generator itself, whose parameters the search may find."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from experiments.errors import UserError
from treefit.fit import aim
from treefit.mask import FOLIAGE, Mask
from treefit.objective import Objective, View
from treefit.placing import place
from treefit.plant import Generator, Plant, check_plant
from treefit.plant.bounds import Bounds
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity
from treefit.view import Frame

STREAM, GROWTH_SEED = 6006, 1_000_000
"""Keep the draws of hidden plants, and the seeds that they grow on, apart from those of any search."""

VERTICES, FACTOR = (500, 6_000), 2.0
"""Vertices of a hidden plant when none are wished for, and how far from the wished number it may be."""

WIDTHS, CROWN_ROWS, FOLIAGE_AREA, FOLIAGE_PART = (0.2, 1.4), 0.35, 0.06, 0.5
"""Width by height, rows with foliage of all, foliage by the square of the height and of the tree, at least."""

CROWN_HEIGHT, CROWN_OFFSET = 0.45, 0.2
"""Where the middle of the foliage is: so high at least, and so far from over the foot at most, in heights."""

MOST_DRAWS, ROWS = 2_000, 256


def hidden_targets(
    generator: Generator, similarity: Similarity[Any], wishes: Characteristics, view: View, count: int, seed: int
) -> dict[str, Mask]:
    """`count` masks by name, of random plants of `generator` that are decent trees; always the same for a `seed`."""
    found: dict[str, Mask] = {}
    trees = _trees(generator, similarity, wishes, view, seed)
    while len(found) < count:
        mask = next(trees, None)
        if mask is None:
            raise UserError(f"compare.hidden: in {MOST_DRAWS} random plants of {generator.name} are only {len(found)} "
                            f"decent trees of the wished size; ask for fewer")  # fmt: skip
        found[f"hidden_{len(found) + 1}"] = mask
    return found


def _trees(
    generator: Generator, similarity: Similarity[Any], wishes: Characteristics, view: View, seed: int
) -> Iterator[Mask]:
    """Masks of the decent ones among random plants, of 256 rows."""
    solid = np.full((ROWS, ROWS), FOLIAGE, np.uint8)  # no matter which: space and budget are those of any fit
    objective = aim(solid, generator, similarity, wishes, view, seed)
    objective = replace(objective, frame=Frame(ROWS, 16))
    for draw in range(MOST_DRAWS):
        genome = np.random.default_rng([seed, STREAM, draw]).random(len(objective.space))
        mask = _mask(objective, objective.grow(genome, seed + GROWTH_SEED + draw), wishes.bounds.get("vertices"))
        if mask is not None:
            yield mask


def _mask(objective: Objective, plant: Plant, wished: Bounds | None) -> Mask | None:
    """Mask of `plant`; None when it is no decent tree."""
    low, high = VERTICES if wished is None else (wished.low / FACTOR, wished.high * FACTOR)
    if plant.cut or not low <= plant.n_vertices <= high or not plant.n_leaves:
        return None
    check_plant(plant)
    mask = objective.view(plant, objective.frame).unpack()
    return mask if _decent(mask) else None


def _decent(mask: Mask) -> bool:
    """Whether the mask, of a tree as high as itself, is that of an upright tree with a crown."""
    rows, columns = np.nonzero(mask == FOLIAGE)
    height = len(mask)
    if len(rows) < max(FOLIAGE_AREA * height**2, FOLIAGE_PART * np.count_nonzero(mask)):
        return False
    at = place(mask)
    return bool(
        WIDTHS[0] <= (at.right - at.left) / height <= WIDTHS[1]
        and len(np.unique(rows)) >= CROWN_ROWS * height
        and 1 - rows.mean() / height >= CROWN_HEIGHT
        and abs(columns.mean() - at.base) <= CROWN_OFFSET * height
    )
