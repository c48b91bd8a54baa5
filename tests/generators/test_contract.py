"""Contract that every generator passes, in all that must and all that should be."""

from __future__ import annotations

import numpy as np
import pytest

from generators.gegen import GEGen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from treefit.plant import Budget, Generator, Plant
from treefit.plant.contract import RULES, Rule, Sample, draw_sample, name_of, same

GENERATORS: dict[str, Generator] = {
    "simplegen": SimpleGen(), "simplegen_paper": SimpleGen(additions=False),
    "weberpenn": WeberPennGen(), "weberpenn_full": WeberPennGen(full=True),
    "gegen": GEGen(),
}  # fmt: skip
SMALL = Budget(4_000, 8_000)
EXCUSED = {("weberpenn_full", "most plants fit the budget"), ("weberpenn_full", "every gene changes the plant")}
"""Nearly all of its random plants are cut, so that last levels are seldom seen: it is for plants of given values."""


@pytest.fixture(scope="module", params=GENERATORS)
def drawn(request: pytest.FixtureRequest) -> tuple[str, Sample]:
    return request.param, draw_sample(GENERATORS[request.param], 300, few=80, seed=5, budget=SMALL)


@pytest.mark.parametrize("rule", RULES, ids=name_of)
def test_every_generator_keeps_every_rule(drawn: tuple[str, Sample], rule: Rule) -> None:
    name, sample = drawn
    if (name, name_of(rule)) not in EXCUSED:
        rule(sample)


def test_the_rules_have_much_to_look_at(drawn: tuple[str, Sample]) -> None:
    _, sample = drawn
    assert len(sample.grown) == 300
    assert sum(not plant.cut and plant.n_vertices > 2 for _, plant in sample.grown[: sample.few]) >= 3
    assert sample.generator.size_parameter is not None


def test_another_seed_gives_another_plant_of_the_defaults(drawn: tuple[str, Sample]) -> None:
    generator = drawn[1].generator
    values = generator.space.complete({})
    assert not same(generator(values, 1, SMALL), generator(values, 2, SMALL))


def plants(generator: Generator, count: int, budget: Budget = SMALL) -> list[Plant]:
    genomes = np.random.default_rng(3).random((count, len(generator.space)))
    return [generator(generator.space.decode(genome), 5, budget) for genome in genomes]
