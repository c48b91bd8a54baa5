"""On which of a generator's presets a parameter shows, for one that changes nothing at the usual values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from experiments.sheet_cells import grow, same
from treefit.mask import BACKGROUND
from treefit.plant import Budget, Generator, Parameter, Plant, Value
from treefit.view import Frame, OrthographicView

HEAVIEST = Budget(vertices=30_000, leaves=150_000)
"""Presets that need more are not tried: a row of them would take minutes."""

PLAIN = 0.03
"""A parameter plainly shows when this share of the plant's pixels changes from its lowest to its highest value."""

_ROWS, _WORDS = 64, 4


@dataclass(frozen=True, eq=False)
class Stage:
    """A preset to show parameters on: all its values by name, and the vertices of its plant."""

    name: str
    values: Mapping[str, Value]
    n_vertices: int


def stages(generator: Generator, seed: int) -> list[Stage]:
    """Presets of `generator` that are not heavy, those of the fewest vertices first."""
    found: list[Stage] = []
    for name, preset in generator.presets.items():
        values = generator.space.complete(preset.values)
        plant = grow(generator, values, seed, HEAVIEST)
        if isinstance(plant, Plant):
            found.append(Stage(name, values, plant.n_vertices))
    return sorted(found, key=lambda stage: (stage.n_vertices, stage.name))


def first_shown(
    generator: Generator, parameter: Parameter, values: Sequence[Value], ready: Sequence[Stage], seed: int
) -> Stage | None:
    """The first of `ready` on which `parameter` plainly shows, else that on which it shows most; None for nowhere."""
    best, most = None, 0.0
    for stage in ready:
        low, high = (
            grow(generator, {**stage.values, parameter.name: value}, seed) for value in (values[0], values[-1])
        )
        if (changed := _difference(low, high)) > most:
            best, most = stage, changed
        if most >= PLAIN:
            break
    return best


def _difference(one: Plant | str, two: Plant | str) -> float:
    """Pixels that differ in small masks by those of the first plant; 0 when there is no plant."""
    if isinstance(one, str) or isinstance(two, str) or same(one, two):
        return 0.0
    view, frame = OrthographicView(resolution=_ROWS), Frame(_ROWS, _WORDS)
    low, high = (view(plant, frame).unpack() for plant in (one, two))
    return float(np.sum(low != high) / max(np.sum(low != BACKGROUND), 1))
