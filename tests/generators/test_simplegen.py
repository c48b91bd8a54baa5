from __future__ import annotations

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from generators.simplegen.parameters import NEUTRAL
from tests.conftest import blob
from treefit.fit import aim
from treefit.plant import Budget, Plant
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

GENERATOR = SimpleGen()


def grow(**values: float) -> Plant:
    return GENERATOR(GENERATOR.space.complete(values), 1, Budget())


def test_the_paper_has_19_parameters_and_the_additions_about_as_many() -> None:
    paper = SimpleGen(fixed={"branch_r_1": 0.5, "branch_r_2": 0.55, "branch_r_3": 0.5}, additions=False)
    assert len(paper.space) == 19
    assert 38 <= len(GENERATOR.space) <= 47
    assert set(NEUTRAL) <= {parameter.name for parameter in GENERATOR.space.parameters}


def test_most_random_genomes_are_trees() -> None:
    genomes = np.random.default_rng(0).random((300, len(GENERATOR.space)))
    target = blob(256, 256)
    objective = aim(target, GENERATOR, PaperSimilarity(), Characteristics(vertices=3000), OrthographicView(), 0)
    scores = np.array([objective(genome).total for genome in genomes])
    assert (scores > 0.01).mean() > 0.7


def test_the_bare_part_of_the_trunk_has_no_branches() -> None:
    plant = grow(branching_start_0=0.6, droop_1=1.0)
    first = plant.level == 1
    attached = plant.position[plant.parent[first]][plant.level[plant.parent[first]] == 0]
    assert attached[:, 2].min() >= 0.55 * plant.position[plant.level == 0][:, 2].max()


CROWN = {"branching_start_0": 0.3, "crown_hang": 0.0, "crown_rise": 0.0, "crown_keep": 1.0, "wobble": 0.0,
         "length_variation": 0.0, "branch_len_1": 0.4, "leaves_count": 0.0}  # fmt: skip


def knots(left: float, right: float) -> dict[str, float]:
    return {f"crown_{side}_{knot}": width for side, width in (("left", left), ("right", right)) for knot in range(5)}


def test_branches_keep_to_the_crown() -> None:
    plant = grow(**CROWN, **knots(0.5, 1.0))
    trunk = plant.position[plant.level == 0][:, 2].max()
    x, y, _ = plant.position[plant.level > 0].T
    width = 0.4 * trunk * (0.75 + 0.25 * x / (np.hypot(x, y) + 1e-6))  # an ellipse between both sides
    assert np.quantile(np.hypot(x, y) / width, 0.98) < 1.1
    assert (np.hypot(x, y) / width).max() > 0.85


def test_each_side_of_the_crown_has_its_width() -> None:
    left, right = (grow(**CROWN, **sides).position[:, 0] for sides in (knots(1.0, 0.3), knots(0.3, 1.0)))
    assert -left.min() > 2 * left.max()
    assert right.max() > -2 * right.min()


def test_a_flat_crown_is_less_deep() -> None:
    deep, flat = (grow(crown_depth=depth).position for depth in (1.0, 0.4))
    assert np.abs(flat[:, 1]).mean() < 0.8 * np.abs(deep[:, 1]).mean()
    assert np.abs(flat[:, 0]).mean() > 0.95 * np.abs(deep[:, 0]).mean()


@pytest.mark.parametrize(("count", "start", "whorl"), [(5, 0.0, 1), (10, 0.35, 3), (7, 0.9, 2)])
def test_children_are_counted_as_they_grow(count: int, start: float, whorl: int) -> None:
    plant = grow(branch_count_0=count, branching_start_0=start, whorl=whorl, length_variation=0.0, crown_keep=0.0)
    stems = ((plant.level[1:] == 1) & (plant.level[plant.parent[1:]] == 0)).sum()
    assert stems == (count - 1) * whorl + 1


def test_radius_never_grows_towards_the_tip() -> None:
    plant = grow()
    assert (plant.radius[1:] <= plant.radius[plant.parent[1:]] + 1e-7).all()


def test_no_leaves_at_all_is_a_winter_tree() -> None:
    plant = grow(leaf_number=0)
    assert plant.n_leaves == 0
    assert plant.n_vertices == grow().n_vertices


def test_a_droop_upwards_raises_the_tips() -> None:
    assert grow(droop_1=1.2).position[:, 2].mean() > grow(droop_1=-1.2).position[:, 2].mean() + 0.5


def test_one_parameter_does_not_reshuffle_the_rest() -> None:
    """Streams are keyed by the place in the tree: wood is the same whatever the leaves do."""
    one, two = grow(leaf_number=1, leaves_count=0.3), grow(leaf_number=5, leaves_count=0.9)
    assert one.position.tobytes() == two.position.tobytes()


def test_a_misspelt_fixed_parameter_is_told() -> None:
    with pytest.raises(ValueError, match="did you mean 'wobble'"):
        SimpleGen(fixed={"woble": 0.1})
