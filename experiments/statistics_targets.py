"""Targets of the task statistics: random plants of all generators and drawn crowns, each with a wish for vertices."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice

import numpy as np

from experiments.drawn_crowns import HABITS, drawn_crown
from generators.gegen import gegen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from treefit.mask import FOLIAGE, Mask
from treefit.placing import place
from treefit.plant import Budget, Generator
from treefit.view import Frame, OrthographicView

ROWS = 256
PLANTS, DRAWN = (500, 8000), (1000, 6000)
"""Least and most vertices that are wished of a plant's own, and of a drawn one."""

FEWEST, LEAST_CROWN, WIDEST = 200, 0.06, 1.0
"""Vertices, foliage in squares of the height, and reach in heights, between which a plant is a tree with a crown."""


@dataclass(frozen=True, eq=False)
class Target:
    """A mask (h, w) of a tree, the vertices that are wished of its model, and what it is."""

    name: str
    mask: Mask
    vertices: int


def targets(count: int, seed: int) -> list[Target]:
    """`count` targets: a third drawn crowns, the others plants of all generators in equal parts."""
    drawn = count // 3
    growing = [_plants(generator, seed) for generator in (SimpleGen(), WeberPennGen(), gegen())]
    plants = list(islice(chain.from_iterable(zip(*growing, strict=False)), count - drawn))
    return plants + [_drawn(i, seed) for i in range(drawn)]


def _plants(generator: Generator, seed: int) -> Iterator[Target]:
    """Yield plants of uniform random genomes, those that are trees with a crown."""
    view, frame = OrthographicView(resolution=ROWS), Frame(ROWS, 2 * ROWS // 64 + 4)
    rng = np.random.default_rng([seed, *generator.name.encode()])
    while True:
        genome, one = rng.random(len(generator.space)), int(rng.integers(2**31))
        plant = generator(generator.space.decode(genome), one, Budget(4 * PLANTS[1], 8 * PLANTS[1]))
        if plant.cut or plant.n_vertices < FEWEST:
            continue
        mask = view(plant, frame).unpack()
        if (mask == FOLIAGE).sum() >= LEAST_CROWN * ROWS**2 and place(mask).reach <= WIDEST:
            yield Target(f"{generator.name} {plant.n_vertices}", mask, int(np.clip(plant.n_vertices, *PLANTS)))


def _drawn(number: int, seed: int) -> Target:
    name = list(HABITS)[number % len(HABITS)]
    rng = np.random.default_rng([seed, number])
    vertices = round(float(np.exp(rng.uniform(*np.log(DRAWN)))))
    return Target(f"drawn {name}", drawn_crown(name, int(rng.integers(2**31))), vertices)


def picture(found: Sequence[Target], columns: int = 9) -> Mask:
    """All masks side by side in rows of `columns`, at half size."""
    cells = [_cell(target.mask) for target in found]
    cells += [np.zeros_like(cells[0])] * (-len(cells) % columns)
    return np.vstack([np.hstack(cells[i : i + columns]) for i in range(0, len(cells), columns)])


def _cell(mask: Mask) -> Mask:
    half, middle = mask[::2, ::2], mask.shape[1] // 4
    return np.pad(half[:, middle - ROWS // 2 : middle + ROWS // 2], 4)
