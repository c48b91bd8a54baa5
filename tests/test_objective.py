from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant import Budget
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView


@pytest.fixture
def objective() -> Objective:
    wishes = Characteristics(vertices=3000, height=12.0)
    return aim(blob(256, 256), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(resolution=64), 3)


def test_the_score_is_image_similarity_times_the_multipliers(objective: Objective) -> None:
    score = objective(np.full(len(objective.space), 0.5))
    assert score.failure is None
    assert set(score.multipliers) == {"vertices", "height"}
    assert score.total == pytest.approx(score.image * np.prod(list(score.multipliers.values())))
    assert 0 < score.total < 1


def test_the_size_is_searched_only_when_a_wish_sees_it(objective: Objective) -> None:
    assert "branch_len_0" in objective.space.names
    free = aim(blob(), SimpleGen(), PaperSimilarity(), Characteristics(), OrthographicView(), 0)
    assert "branch_len_0" not in free.space.names


def test_the_size_in_metres_does_not_change_the_image_similarity(objective: Objective) -> None:
    genome = np.full(len(objective.space), 0.5)
    images = []
    for size in (4.0, 20.0):
        fixed = replace(objective, space=objective.space.fix(branch_len_0=size))
        images.append(fixed(np.delete(genome, objective.space.names.index("branch_len_0"))).image)
    assert images[0] == pytest.approx(images[1], abs=0.01)


def test_an_objective_can_be_pickled(objective: Objective) -> None:
    genome = np.full(len(objective.space), 0.4)
    assert pickle.loads(pickle.dumps(objective))(genome) == objective(genome)


@pytest.mark.parametrize("how", ["raise", "nan", "cycle", "empty"])
def test_a_failing_generator_costs_the_score_and_tells_why(objective: Objective, how: str) -> None:
    failing = replace(objective, generator=Failing(1.0, how))
    score = failing(np.full(len(objective.space), 0.5))
    assert score.total == 0
    assert score.failure


def test_a_plant_over_budget_scores_nothing(objective: Objective) -> None:
    score = replace(objective, budget=Budget(20, 10))(np.full(len(objective.space), 0.5))
    assert score.total == 0
    assert str(score.failure).startswith("over budget")
