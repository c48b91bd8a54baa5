"""The guesses that the project ships: small, of its generators as they are, and better than chance."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from experiments.compare_targets import hidden_targets
from generators.gegen import gegen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from treefit.family.guess import find_guess
from treefit.family.hints import hints_of
from treefit.fit import aim
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Mix
from treefit.view import OrthographicView

SHIPPED = [SimpleGen, WeberPennGen, gegen]
TRIES = 40


@pytest.mark.parametrize("make", SHIPPED, ids=lambda make: make.__name__)
def test_every_generator_has_a_small_guess_for_its_space(make: Callable[[], Generator]) -> None:
    generator = make()
    found = find_guess(generator)
    assert found is not None
    assert set(found.names) == set(generator.space.names)
    assert found.missed < -0.74 - 0.1  # a uniform guess has -0.74
    assert generator.family is not None
    assert sum(path.stat().st_size for path in generator.family.glob("guess*.npz")) < 1_000_000


@pytest.mark.parametrize("make", SHIPPED, ids=lambda make: make.__name__)
def test_the_best_of_a_few_guesses_beats_that_of_as_many_random_plants(make: Callable[[], Generator]) -> None:
    generator, view, wishes = make(), OrthographicView(resolution=64), Characteristics()
    led, blind = [], []
    for mask in hidden_targets(generator, Mix(), wishes, view, 4, 0).values():
        objective = aim(mask, generator, Mix(), wishes, view, 0)
        guess = hints_of(objective, mask).guess
        random = np.random.default_rng([0, 1]).random((TRIES, len(objective.space)))
        for found, genomes in ((led, guess[:TRIES]), (blind, random)):
            found.append(max(objective(genome).total for genome in genomes))
    assert sum(led) > sum(blind) + 0.1
