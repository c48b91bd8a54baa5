"""Hints of a fit: what presets, earlier runs and the statistics of the family say about the target at hand."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from treefit.family.statistics import find_statistics
from treefit.mask import Mask
from treefit.objective import Objective
from treefit.plant import Values
from treefit.search import Hints
from treefit.search.hints import Genomes

_log = logging.getLogger(__name__)


def hints_of(objective: Objective, mask: Mask, start: Sequence[Values] = ()) -> Hints:  # noqa: ARG001
    """Hints for `objective`, whose target is `mask`; values of `start` are known before those of the presets.

    StaleError or FamilyError, of one line with what to do, for files of the generator that cannot be used.
    """
    hints = replace(Hints.none(len(objective.space)), known=_known(objective, start))
    statistics = find_statistics(objective.generator, objective.similarity)
    if statistics is None:
        _log.info("no statistics of %s for this similarity: V and Q are uniform", objective.generator.name)
        return hints
    rate, quality = statistics.for_space(objective.space)
    return replace(hints, rate=rate, quality=quality)


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
