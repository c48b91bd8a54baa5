"""Hints of a fit: what presets, earlier runs and the statistics of the family say about the target at hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from treefit.mask import Mask
from treefit.objective import Objective
from treefit.plant import Values
from treefit.search import Hints
from treefit.search.hints import Genomes


def hints_of(objective: Objective, mask: Mask, start: Sequence[Values] = ()) -> Hints:  # noqa: ARG001
    """Hints for `objective`, whose target is `mask`; values of `start` are known before those of the presets."""
    hints = Hints.none(len(objective.space))
    return replace(hints, known=_known(objective, start))


def _known(objective: Objective, start: Sequence[Values]) -> Genomes:
    """Genomes (m, n) of `start` and of the generator's presets; ValueError for a parameter that it lacks."""
    given: Mapping[str, Values] = {
        **{f"start {i + 1}": values for i, values in enumerate(start)},
        **{f"preset {name!r}": preset.values for name, preset in objective.generator.presets.items()},
    }
    known = np.empty((0, len(objective.space)))
    for name, values in given.items():
        try:
            known = np.vstack([known, objective.space.encode(values)])
        except ValueError as error:
            raise ValueError(f"{name} of generator {objective.generator.name!r}: {error}") from None
    return known
