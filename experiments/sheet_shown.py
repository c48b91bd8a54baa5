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
"""Pixels of a small mask, by those of the plant, that a parameter changes when it plainly shows."""

_CHANGED = Budget(2 * HEAVIEST.vertices, 2 * HEAVIEST.leaves)
_ROWS, _WORDS = 64, 4


@dataclass(frozen=True, eq=False)
class Stage:
    """A preset to show parameters on: all values by name, and the plant that they make."""

    name: str
    values: Mapping[str, Value]
    plant: Plant


def stages(generator: Generator, seed: int) -> list[Stage]:
    """Presets of `generator` that are not heavy, those of the fewest vertices first."""
    found: list[Stage] = []
    for name, preset in generator.presets.items():
        values = generator.space.complete(preset.values)
        plant = grow(generator, values, seed, HEAVIEST)
        if isinstance(plant, Plant):
            found.append(Stage(name, values, plant))
    return sorted(found, key=lambda stage: (stage.plant.n_vertices, stage.name))


def first_shown(
    generator: Generator, parameter: Parameter, values: Sequence[Value], ready: Sequence[Stage], seed: int
) -> Stage | None:
    """The first of `ready` on which `parameter` plainly shows, else that on which it shows most; None for nowhere."""
    best, most = None, 0.0
    for stage in ready:
        changed = max(_change(generator, stage, parameter.name, value, seed) for value in (values[0], values[-1]))
        if changed > most:
            best, most = stage, changed
        if most >= PLAIN:
            break
    return best


def _change(generator: Generator, stage: Stage, name: str, value: Value, seed: int) -> float:
    """Share of the pixels that differ when the parameter `name` of a preset becomes `value`."""
    plant = grow(generator, {**stage.values, name: value}, seed, _CHANGED)
    if isinstance(plant, str) or same(plant, stage.plant):
        return 0.0
    view, frame = OrthographicView(resolution=_ROWS), Frame(_ROWS, _WORDS)
    one, two = (view(each, frame).unpack() for each in (stage.plant, plant))
    return float(np.sum(one != two) / max(np.sum(one != BACKGROUND), 1))
