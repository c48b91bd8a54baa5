from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.evaluation import Evaluator
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView


@pytest.fixture(scope="module")
def objective() -> Objective:
    wishes = Characteristics(vertices=500)
    return aim(blob(), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(resolution=64), 0)


@pytest.fixture(scope="module")
def genomes(objective: Objective) -> np.ndarray:
    return np.random.default_rng(5).random((50, len(objective.space)))


@pytest.mark.parametrize(
    "evaluator",
    [Evaluator("threads", 1), Evaluator("threads", 3, 7), Evaluator("auto"), Evaluator("processes", 2, 20)],
    ids=str,
)
def test_scores_do_not_depend_on_workers(objective: Objective, genomes: np.ndarray, evaluator: Evaluator) -> None:
    assert evaluator(objective, genomes) == Evaluator("serial")(objective, genomes)


def test_a_generator_of_plain_python_goes_to_processes(objective: Objective) -> None:
    slow = replace(objective, generator=Failing(parallel="processes"))
    assert Evaluator().backend(slow) == "processes"
    assert Evaluator().backend(objective) == "threads"


def test_a_dying_worker_costs_only_its_candidates(objective: Objective, genomes: np.ndarray) -> None:
    dying = replace(objective, generator=Failing(0.2, "exit", "processes"))
    few = genomes[:6]
    few[:, objective.space.names.index("wobble")] = [0.5, 0.1, 0.6, 0.7, 0.8, 0.9]
    scores = Evaluator("processes", 2, 3)(dying, few)
    assert ["process died" in str(score.failure) for score in scores] == [False, True, False, False, False, False]
    assert scores[2:] == Evaluator("serial")(objective, few[2:])


def test_a_setting_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="workers"):
        Evaluator(workers=-1)
