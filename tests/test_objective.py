from __future__ import annotations

import pickle
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant import Budget, Plant
from treefit.plant.characteristics import Characteristics, OfHeight
from treefit.plant.extent import extent_of
from treefit.similarity import PaperSimilarity
from treefit.view import BitMask, OrthographicView


@dataclass(frozen=True)
class Sides:
    """A view and a similarity in one: the sides are numbers, and their own similarity."""

    images: tuple[float, ...]
    reduce: str = "mean"
    resolution: int = 64
    parallel: str = "threads"

    def __call__(self, plant: Plant, frame: Any) -> BitMask:
        raise AssertionError("a score sees the sides only")

    def sides(self, plant: Plant, frame: Any) -> Any:
        return self.images

    def describe(self, bits: Any) -> Any:
        return bits

    def compare(self, target: Any, plant: Any) -> float:
        return float(plant)


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


def test_a_width_from_the_image_is_that_of_the_tree_in_the_mask_at_the_wished_height() -> None:
    wishes = Characteristics(height=10.0, width="from_image")
    found = aim(blob(crown=0.3), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(), 0)
    assert found.characteristics.width == OfHeight(pytest.approx(0.6, abs=0.01))
    assert "branch_len_0" in found.space.names
    plant = found.grow(np.full(len(found.space), 0.5), 0)
    extent, multipliers = extent_of(plant), found.score(plant).multipliers
    width = extent.width / 6.0
    assert multipliers["width"] == pytest.approx(min(width, 1 / width), rel=0.02)


def test_the_budget_follows_from_the_most_that_is_wished_for() -> None:
    wishes = Characteristics(vertices={"max": 5000})
    assert aim(blob(), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(), 0).budget == Budget(20_000, 40_000)
    given = aim(blob(), SimpleGen(), PaperSimilarity(), wishes, OrthographicView(), 0, Budget(300, 400))
    assert given.budget == Budget(300, 400)


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


@pytest.mark.parametrize(("how", "image"), [("mean", 0.5), ("best", 0.75), ("worst", 0.25)])
def test_the_similarities_of_the_sides_are_joined(objective: Objective, how: str, image: float) -> None:
    sides = Sides((0.75, 0.25), how)
    score = replace(objective, view=sides, similarity=sides)(np.full(len(objective.space), 0.5))
    assert score.image == image
    assert score.total == image * np.prod(list(score.multipliers.values()))


def test_the_worst_side_is_never_over_the_mean_nor_that_over_the_best(objective: Objective) -> None:
    views = [OrthographicView(64, azimuths=3, reduce=how) for how in ("worst", "mean", "best")]
    for genome in np.random.default_rng(4).random((20, len(objective.space))):
        worst, mean, best = (replace(objective, view=view)(genome).image for view in views)
        assert worst <= mean <= best
        assert worst <= objective(genome).image <= best


def test_a_plant_is_drawn_only_where_its_multipliers_leave_it_a_chance(objective: Objective) -> None:
    undrawable = replace(objective, view=Sides(()))
    for genome in np.random.default_rng(4).random((20, len(objective.space))):
        score = objective(genome)
        bound = float(np.prod(list(score.multipliers.values())))
        assert score.total <= bound
        assert objective(genome, np.nextafter(bound, 0)) == score
        hopeless = undrawable(genome, bound)
        assert (hopeless.total, hopeless.drawn, hopeless.failure) == (0, not score.multipliers, score.failure)


def test_a_plant_that_is_not_drawn_is_checked_all_the_same(objective: Objective) -> None:
    failing = replace(objective, generator=Failing(1.0, "nan"))
    assert failing(np.full(len(objective.space), 0.5), floor=1.0).failure
