"""The resource of a year in GEGen: what the root is given is what all buds get together, and bounds their shoots."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from generators.gegen import growth, year
from generators.gegen.tree import DEAD, GIVEN, KEPT, LATERALS, Tree
from generators.gegen.year import LEAST
from tests.generators.grown import grow
from tests.generators.interpreted import interpreted
from treefit.plant import Value

SMALL: dict[str, Value] = {"age": 13, "leader": 16, "internodes": 300, "trunk": 0.1, "apical_control": -0.05}
SHADY: dict[str, Value] = {**SMALL, "shade": 1.0, "shedding": 0.3}
LEAN: dict[str, Value] = {**SMALL, "apical_control": -0.1, "apical_loss": 0.2, "priority": 0.2, "bud_share": 1.0}


@dataclass
class Year:
    """What was given in one year, to the root, to buds and tips, and what was left."""

    given: float
    buds: float = 0.0
    tips: float = 0.0
    left: float = 0.0
    axes: list[int] = field(default_factory=list)


def years(**values: Value) -> list[Year]:
    """Resource of the years of a tree."""
    found: list[Year] = []
    with interpreted() as patch:
        share, run = year.share, growth.share_year

        def shared(tree: Tree, a: int, given: float, *rest: object) -> int:
            count = int(share(tree, a, given, *rest))
            places, amounts = rest[-3], rest[-2]
            assert isinstance(places, np.ndarray)
            assert isinstance(amounts, np.ndarray)
            buds = tree.node[places[: count - 1], LATERALS] == 0
            found[-1].buds += float(amounts[: count - 1][buds].sum())
            found[-1].tips += float(amounts[count - 1])
            found[-1].axes.append(a)
            return count

        def ran(rule: object, tree: Tree, axes: int, *rest: object) -> int:
            found.append(Year(float(tree.axis[0, GIVEN])))
            after = int(run(rule, tree, axes, *rest))
            alive = tree.stem[:axes, DEAD] == 0
            found[-1].left = float(tree.axis[:axes, GIVEN][alive].sum())
            assert (tree.axis[:axes, GIVEN][alive] < LEAST).all()
            assert (tree.axis[:after, KEPT] < 1).all()
            assert (tree.axis[:after, KEPT] >= 0).all()
            return after

        patch.setattr(year, "share", shared)
        patch.setattr(growth, "share_year", ran)
        grow(**values)
    return found


@pytest.mark.parametrize("values", [SMALL, SHADY, LEAN], ids=["small", "shady", "lean"])
def test_what_the_root_is_given_is_what_buds_and_tips_get(values: dict[str, Value]) -> None:
    found = years(**values)
    assert len(found) >= 6
    assert max(len(one.axes) for one in found) >= 8
    for one in found:
        assert len(set(one.axes)) == len(one.axes)
        assert one.buds + one.tips + one.left == pytest.approx(one.given, rel=1e-4)


def test_kernels_grow_the_tree_that_python_grows() -> None:
    compiled = grow(**SHADY)
    with interpreted():
        plain = grow(**SHADY)
    assert compiled.joint.shape == plain.joint.shape
    assert compiled.plant.position == pytest.approx(plain.plant.position, abs=1e-4)
    assert compiled.plant.radius == pytest.approx(plain.plant.radius, rel=1e-4)
    assert compiled.plant.leaf_position == pytest.approx(plain.plant.leaf_position, abs=1e-4)
