"""Grown: trees of the project's own generators, from their presets and from genomes of chance."""

from __future__ import annotations

from functools import cache

import numpy as np

from generators.gegen import gegen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from scripts.mask_training.scenery.arrays import Rng, chance
from scripts.mask_training.scenery.model import Model, leafier, model_of
from treefit.plant import Budget, Generator, Plant

BUDGET = Budget(18_000, 70_000)
TRIES = 12
CONIFERS = {
    "norway_spruce", "silver_fir", "scots_pine", "stone_pine", "european_larch", "italian_cypress", "thuja", "spruce",
    "umbrella_pine",
}  # fmt: skip
LEAST_VERTICES, LEAST_LEAVES, WIDEST = 200, 400, 1.0
"""A tree with a crown has as many vertices and leaves, and reaches no farther sideways, in heights."""
LEAST_CROWN, THICKEST = 0.06, 0.06
"""Height times width of the middle of the crown in squared heights, and radius of the trunk in heights."""


def grown(rng: Rng, leaves: int) -> Model:
    """A tree of a generator of chance, with leaves enough to be a crown but at most `leaves`."""
    for _ in range(TRIES):
        name, plant = _plant(rng)
        if _decent(plant):
            cover = float(np.exp(rng.uniform(np.log(1.0), np.log(9.0))))
            return leafier(model_of(plant, name in CONIFERS), cover, leaves, rng)
    generator = _generators()[2]
    preset = generator.presets["oak"]
    return leafier(model_of(generator(preset.values, 1, BUDGET), False), 3.0, leaves, rng)


def grown_bare(rng: Rng) -> Model:
    """A tree of a generator with all its twigs; its leaves are to be dropped."""
    for _ in range(TRIES):
        _, plant = _plant(rng)
        if plant.n_vertices >= 600 and _reach(plant) <= WIDEST:
            return model_of(plant, False)
    generator = _generators()[2]
    return model_of(generator(generator.presets["winter"].values, 1, BUDGET), False)


@cache
def _generators() -> tuple[Generator, ...]:
    return SimpleGen(), WeberPennGen(), gegen()


def _plant(rng: Rng) -> tuple[str, Plant]:
    generator = _generators()[int(rng.choice(3, p=(0.15, 0.45, 0.4)))]
    seed = int(rng.integers(2**31))
    if not generator.presets or chance(rng, 0.22):
        return "", generator(generator.space.decode(rng.random(len(generator.space))), seed, BUDGET)
    name = str(rng.choice(list(generator.presets)))
    values = generator.presets[name].values
    if chance(rng, 0.5):
        genome = generator.space.encode(values) + rng.normal(0, 0.08, len(generator.space))
        values = generator.space.decode(np.clip(genome, 0, 1))
    return name, generator(values, seed, BUDGET)


def _decent(plant: Plant) -> bool:
    if plant.n_vertices < LEAST_VERTICES or plant.n_leaves < LEAST_LEAVES or _reach(plant) > WIDEST:
        return False
    height = max(float(plant.position[:, 2].max()), 1e-3)
    low, high = np.quantile(plant.leaf_position, (0.1, 0.9), axis=0) / height
    crown = (high[2] - low[2]) * max(high[0] - low[0], high[1] - low[1])
    return bool(crown >= LEAST_CROWN and float(np.quantile(plant.radius, 0.98)) < THICKEST * height)


def _reach(plant: Plant) -> float:
    """Farthest vertex from the trunk sideways, in heights."""
    height = max(float(plant.position[:, 2].max()), 1e-3)
    return float(np.abs(plant.position[:, :2]).max()) / height
