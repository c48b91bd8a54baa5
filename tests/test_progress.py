from __future__ import annotations

import json
from dataclasses import asdict, replace

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.fit import aim
from treefit.objective import Objective, Score
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation, Progress
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

SCORES = [Score(0.5, 0.6), Score(0.0, drawn=False), Score(0.0, failure="Oak: rotten"), Score(0.1)]


@pytest.fixture(scope="module")
def objective() -> Objective:
    return aim(blob(), SimpleGen(), PaperSimilarity(), Characteristics(), OrthographicView(resolution=64), 0)


def add(progress: Progress, objective: Objective, scores: list[Score]) -> list[Failure]:
    return progress.add("root", objective, np.full((len(scores), len(objective.space)), 0.5), scores, 2.0)


def test_a_generation_sums_up_its_batch_and_the_run(objective: Objective) -> None:
    progress = Progress()
    add(progress, objective, SCORES)
    failures = add(progress, objective, SCORES[1:])
    assert progress.history[0] == Generation(0, "root", 4, 0.5, 0.6, pytest.approx(0.2), 1, 1, 2.0, 2.0)
    assert progress.history[1] == Generation(1, "root", 7, 0.5, 0.6, pytest.approx(0.05), 2, 2, 2.0, 3.5)
    assert [failure.reason for failure in failures] == ["Oak: rotten"]
    assert progress.failures == {"Oak": 2}


def test_the_undrawn_do_not_count_in_the_mean(objective: Objective) -> None:
    some, none = Progress(), Progress()
    add(some, objective, SCORES)
    add(none, objective, [score for score in SCORES if score.drawn])
    assert some.history[0].mean == none.history[0].mean
    add(some, objective, [replace(SCORES[1])] * 3)
    assert some.history[1].mean == 0


def test_a_better_plant_is_an_improvement_and_one_as_good_is_not(objective: Objective) -> None:
    progress = Progress()
    for scores in (SCORES, SCORES, [Score(0.4), Score(0.7, 0.8)], [Score(0.9, 0.9)] * 5):
        add(progress, objective, scores)
    assert [(one.evaluations, one.score, one.image) for one in progress.improvements] == [
        (4, 0.5, 0.6), (10, 0.7, 0.8), (15, 0.9, 0.9),
    ]  # fmt: skip
    assert progress.improvements[0].genome == (0.5,) * len(objective.space)


def test_progress_comes_back_from_json(objective: Objective) -> None:
    progress = Progress()
    add(progress, objective, SCORES)
    assert Progress.from_json(json.loads(json.dumps(asdict(progress)))) == progress
