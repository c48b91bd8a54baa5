"""Arrays of a foreign tree become a Plant, or one line says why they do not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from generators.external.arrays import plant_of

FORK: dict[str, ArrayLike] = {
    "position": [[1, 2, 3], [1, 2, 5], [1, 2, 7], [2, 2, 6]], "parent": [-1, 0, 1, 1], "radius": [0.3, 0.2, 0.1, 0.05],
}  # fmt: skip
LEAVES: dict[str, ArrayLike] = {
    "leaf_position": [[2, 2, 6], [1, 2, 7]], "leaf_axis": [[0, 0, 2], [3, 0, 0]], "leaf_size": [[0.2, 0.1], [0.4, 0.2]],
}  # fmt: skip


def test_the_root_moves_to_the_origin_and_the_thickest_child_goes_on_with_the_stem() -> None:
    plant = plant_of(FORK)
    assert plant.position.tolist() == [[0, 0, 0], [0, 0, 2], [0, 0, 4], [1, 0, 3]]
    assert plant.level.tolist() == [0, 0, 0, 1]
    assert plant.n_leaves == 0


@pytest.mark.parametrize("order", [[3, 2, 1, 0], [2, 0, 3, 1], [1, 3, 0, 2]])
def test_vertices_may_come_in_any_order(order: list[int]) -> None:
    place = np.argsort(order)
    parent = np.array(FORK["parent"])[order]
    shuffled = {"position": np.array(FORK["position"])[order], "radius": np.array(FORK["radius"])[order],
                "parent": np.where(parent < 0, -1, place[parent])}  # fmt: skip
    plant = plant_of(shuffled)
    assert (plant.parent[1:] < np.arange(1, 4)).all()
    ends = {tuple(plant.position[i]): tuple(plant.position[plant.parent[i]]) for i in range(1, 4)}
    assert ends == {(0, 0, 2): (0, 0, 0), (0, 0, 4): (0, 0, 2), (1, 0, 3): (0, 0, 2)}


def test_directions_of_leaves_become_unit_and_normals_square_to_them() -> None:
    plant = plant_of({**FORK, **LEAVES})
    assert plant.leaf_axis.tolist() == [[0, 0, 1], [1, 0, 0]]
    np.testing.assert_allclose((plant.leaf_axis * plant.leaf_normal).sum(axis=1), 0, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(plant.leaf_normal, axis=1), 1, atol=1e-6)
    assert plant.leaf_normal[1].tolist() == [0, 0, 1]
    assert plant.leaf_position.tolist() == [[1, 0, 3], [0, 0, 4]]


def test_y_upwards_is_turned() -> None:
    turned = {**FORK, "position": np.array(FORK["position"])[:, [0, 2, 1]] * [1, 1, -1]}
    np.testing.assert_array_equal(plant_of(turned, "y").position, plant_of(FORK).position)


def changed(**arrays: Any) -> dict[str, ArrayLike]:
    return {**FORK, **LEAVES, **arrays}


WRONG: dict[str, dict[str, ArrayLike]] = {
    "lacks radius": {name: FORK[name] for name in ("position", "parent")},
    "is empty, it has 1 vertices": {"position": [[0, 0, 0]], "parent": [-1], "radius": [1]},
    "is empty, it has 0 vertices": {"position": np.zeros((0, 3)), "parent": [], "radius": np.zeros(0)},
    "position and radius must be as many": changed(position=[[0, 0, 0]] * 3),
    r"position must have shape \(any, 3\)": changed(position=[[0, 0]] * 4),
    "radius must have 1 axes": changed(radius=[[1.0]] * 4),
    "radius must be numbers": changed(radius=["a"] * 4),
    "needs one root, .* has 2": changed(parent=[-1, 0, -1, 1]),
    "needs one root, .* has 0": changed(parent=[1, 2, 3, 0]),
    "go in a circle: vertex 1": changed(parent=[-1, 2, 1, 0]),
    "parent 9 is no vertex": changed(parent=[-1, 0, 9, 1]),
    "parent must be whole numbers": changed(parent=[-1, 0.5, 0, 1]),
    "parent must be from -1": changed(parent=[-7, 0, 0, 1]),
    "NaN or infinite": changed(position=[[0, 0, 0], [0, 0, np.nan], [0, 0, 2], [1, 0, 1]]),
    "position has NaN or infinite": changed(position=[[0, 0, 0], [1e300, 0, 1], [0, 0, 2], [1, 0, 1]]),
    "radius must not be negative": changed(radius=[1, 1, -1, 1]),
    "reaches 2e\\+06 m from its root": changed(position=[[0, 0, 0], [0, 0, 1], [2e6, 0, 2], [1, 0, 1]]),
    "all of its vertices are at one place": changed(position=[[1, 1, 1]] * 4),
    "needs leaf_axis and leaf_size": {**FORK, "leaf_position": [[0, 0, 0]]},
    "leaf_axis must not be of length 0": changed(leaf_axis=[[0, 0, 1], [0, 0, 0]]),
    "leaf_size must not be negative": changed(leaf_size=[[1, 1], [1, -1]]),
    r"leaf_size must have shape \(2, 2\)": changed(leaf_size=[[1, 1]]),
    r"must have shape \(2, 3\) as leaf_position": changed(leaf_axis=[[0, 0, 1]]),
    r"level must have shape \(4,\)": changed(level=[0, 0]),
}


@pytest.mark.parametrize("message", WRONG)
def test_what_is_no_tree_is_said_in_one_line(message: str) -> None:
    with pytest.raises(ValueError, match=message) as told:
        plant_of(WRONG[message])
    assert "\n" not in str(told.value)
