"""Hints of a fit: what presets, earlier runs and the statistics of the family say about the target at hand."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from treefit.family.features import features
from treefit.family.guess import find_guess
from treefit.family.statistics import find_statistics
from treefit.mask import Mask
from treefit.objective import Objective
from treefit.plant import Values
from treefit.search import Hints
from treefit.search.hints import Floats, Genomes
from treefit.search.operators import mirrored
from treefit.view import BitMask, sample

DRAWS = 200
"""Genomes of a guess."""

_log = logging.getLogger(__name__)


def hints_of(objective: Objective, mask: Mask, start: Sequence[Values] = ()) -> Hints:
    """Hints for `objective`, whose target is `mask`; values of `start` are known before those of the presets.

    StaleError or FamilyError, of one line with what to do, for files of the generator that cannot be used.
    """
    hints = replace(Hints.none(len(objective.space)), known=_known(objective, start))
    statistics, guess = find_statistics(objective.generator, objective.similarity), find_guess(objective.generator)
    if statistics is None:
        _log.info("no statistics of %s for this similarity and these parameters: V and Q are uniform",
                  objective.generator.name)  # fmt: skip
    else:
        rate, quality = statistics.for_space(objective.space)
        hints = replace(hints, rate=rate, quality=quality)
    if guess is None:
        _log.info("no guess for these parameters of %s: what the picture shows does not lead the start",
                  objective.generator.name)  # fmt: skip
        return hints
    look = features(BitMask.pack(sample(mask, objective.frame)))
    guessed = guess.for_space(objective.space, look, _wished(objective))
    return replace(hints, guess=_draws(*guessed, objective.seed))


def _wished(objective: Objective) -> float | None:
    """Count of vertices that is wished for, None for any."""
    wish = objective.characteristics.bounds.get("vertices")
    return None if wish is None else wish.middle


def _draws(mean: Floats, deviation: Floats, correlation: Floats, seed: int) -> Genomes:
    """Genomes (DRAWS, n): the mean, then draws around it, every other one half as far from it."""
    squares, axes = np.linalg.eigh(correlation)
    rng = np.random.default_rng([seed, 11])
    steps = rng.standard_normal((DRAWS, len(mean))) * np.sqrt(np.maximum(squares, 0)) @ axes.T
    steps[0] = 0
    steps[2::2] /= 2
    return mirrored(mean + deviation * steps)


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
