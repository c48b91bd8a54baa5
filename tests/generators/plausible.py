"""What makes a random plant plausible, and how many of a generator's are: at the budget of 3,000 wanted vertices."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from treefit.fit import aim
from treefit.mask import Mask
from treefit.plant import Generator, Plant
from treefit.plant.characteristics import Characteristics
from treefit.plant.extent import extent_of
from treefit.similarity import Mix
from treefit.view import OrthographicView

WIDTHS = 0.1, 3.0
"""By the height: a crown is neither a pole nor wider than that."""


def plausible(plant: Plant) -> bool:
    if plant.cut or plant.n_leaves == 0:
        return False
    extent = extent_of(plant)
    return WIDTHS[0] <= extent.width / extent.height <= WIDTHS[1]


def plausible_share(
    generator: Generator, pictures: Sequence[Mask], count: int, rule: Callable[[Plant], bool] = plausible
) -> float:
    """Share of `count` random genomes whose plants keep to `rule` and score on every picture."""
    wishes = Characteristics(vertices=3000)
    objectives = [aim(mask, generator, Mix(), wishes, OrthographicView(), 0) for mask in pictures]
    good = 0
    for genome in np.random.default_rng(0).random((count, len(generator.space))):
        plant = generator(generator.space.decode(genome), 0, objectives[0].budget)
        good += rule(plant) and all(objective(genome).total > 0 for objective in objectives)
    return good / count
