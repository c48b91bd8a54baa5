from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest

from tests.conftest import blob
from treefit.mask import Mask
from treefit.similarity.measures import Agreement, agreement, mean_agreement
from treefit.similarity.measures.contour import contour, contour_distance
from treefit.similarity.measures.rows import rows_of
from treefit.similarity.measures.trunk import bare_trunk, trunk_width

ONE = np.array([[0, 1, 2, 2], [0, 0, 2, 0]], np.uint8)
TWO = np.array([[0, 1, 1, 2], [0, 2, 0, 0]], np.uint8)
ALIKE = {
    "silhouette_iou": 1, "hull_iou": 1, "class_iou": 1, "branch_iou": 1, "contour_distance": 0, "texture": 1,
    "fill_ratio": 1, "runs_ratio": 1, "roughness_ratio": 1, "bare_trunk_error": 0, "trunk_width_error": 0,
}  # fmt: skip


def tree(bare: int = 30, thick: int = 4, half: int = 20) -> Mask:
    """Mask (100, 64) of a rectangular crown on a trunk that is `bare` rows high and `thick` pixels wide."""
    mask = np.zeros((100, 64), np.uint8)
    mask[: 100 - bare, 32 - half : 32 + half] = 2
    mask[100 - bare :, 32 - thick // 2 : 32 + thick // 2] = 1
    return mask


@pytest.mark.parametrize("mask", [tree(), blob(256, 256), ONE, np.full((9, 9), 1, np.uint8)])
def test_a_mask_agrees_with_itself_in_every_measure(mask: Mask) -> None:
    assert asdict(agreement(mask, mask)) == pytest.approx(ALIKE)


def test_overlaps_are_shared_by_joined_pixels() -> None:
    found = agreement(ONE, TWO)
    assert found.silhouette_iou == pytest.approx(3 / 5)
    assert found.branch_iou == pytest.approx(1 / 2)
    assert found.class_iou == pytest.approx((3 / 5 + 1 / 2 + 1 / 4) / 3)


def test_a_class_in_neither_mask_does_not_count() -> None:
    leaves = np.where(tree() > 0, 2, 0).astype(np.uint8)
    found = agreement(leaves, leaves)
    assert (found.class_iou, found.branch_iou) == (1, 1)


def test_gaps_do_not_change_the_hull_and_places_do() -> None:
    holed = tree()
    holed[10:60:2, 20:40] = 0
    found = agreement(tree(), holed)
    assert found.hull_iou == 1
    assert found.silhouette_iou == pytest.approx(1 - 25 * 20 / (70 * 40 + 30 * 4))
    moved = agreement(tree(), np.roll(tree(), 11, axis=1))
    assert moved.hull_iou == moved.silhouette_iou < 1


def test_the_contour_is_the_pixels_with_a_neighbour_outside() -> None:
    square = np.zeros((5, 5), bool)
    square[1:5, 1:5] = True
    assert np.array_equal(contour(square)[1:, 1:], [[1, 1, 1, 1], [1, 0, 0, 1], [1, 0, 0, 1], [1, 1, 1, 1]])


def test_two_lines_are_their_distance_apart_in_percent_of_the_height() -> None:
    one, two, none = np.zeros((3, 50, 40), bool)
    one[:, 10], two[:, 15] = True, True
    assert contour_distance(one, two) == pytest.approx(100 * 5 / 50)
    assert contour_distance(one, none) == 100
    assert contour_distance(none, none) == 0


def test_contour_distance_is_the_mean_of_both_directions() -> None:
    one, two = np.zeros((2, 20, 40), bool)
    one[5, 5] = True
    two[5, [5, 15]] = True
    assert contour_distance(one, two) == contour_distance(two, one) == pytest.approx(100 * (0 + 10 / 2) / 2 / 20)


def test_rows_tell_fill_runs_and_roughness() -> None:
    rows = rows_of(np.array([[0, 0, 0, 0, 0], [1, 0, 2, 2, 0], [0, 2, 2, 0, 0], [0, 2, 0, 2, 0]], np.uint8))
    assert rows.left.tolist() == [0, 0, 1, 1]
    assert rows.right.tolist() == [0, 4, 3, 4]
    assert rows.fill == pytest.approx(7 / 9)
    assert rows.mean_runs == pytest.approx(5 / 3)
    assert rows.roughness == pytest.approx(100 * (1 + 1 + 0 + 1) / 4 / 4)


@pytest.mark.parametrize("finer", [2, 4])
def test_roughness_does_not_depend_on_the_count_of_pixels(finer: int) -> None:
    rng = np.random.default_rng(0)
    mask = (np.arange(64) < rng.integers(20, 60, (120, 1))).astype(np.uint8)
    fine = np.kron(mask, np.ones((finer, finer), np.uint8))
    assert rows_of(fine).roughness == pytest.approx(rows_of(mask).roughness, rel=0.02)


def test_ratios_are_those_of_the_plant_to_the_target() -> None:
    combed = tree()
    combed[:70, 14:50:4] = 0
    found = agreement(tree(), combed)
    assert found.runs_ratio == pytest.approx((70 * 10 + 30) / 100)
    assert found.fill_ratio == pytest.approx(1 - 9 * 70 / (70 * 40 + 30 * 4))
    back = agreement(combed, tree())
    assert back.runs_ratio == pytest.approx(1 / found.runs_ratio)
    assert back.fill_ratio == pytest.approx(1 / found.fill_ratio)


def test_texture_is_that_of_the_bands_by_the_hull_of_the_target() -> None:
    combed = tree()
    combed[:70, 14:50:4] = 0
    crown, trunk = 70 * 40, 30 * 4
    band = 0.35 * 0.05 / (1.05 - 31 / 40) + 0.40 / 10 + 0.25
    assert agreement(tree(), combed).texture == pytest.approx((crown * band + trunk) / (crown + trunk))


def test_texture_does_not_see_where_the_gaps_are() -> None:
    one, two = tree(), tree()
    one[:70:2, 20:30], two[:70:2, 34:44] = 0, 0
    assert agreement(one, two).texture == pytest.approx(1)


@pytest.mark.parametrize("bare", [0, 5, 30, 60])
def test_the_trunk_is_bare_up_to_the_crown(bare: int) -> None:
    assert bare_trunk(tree(bare)) == pytest.approx(bare, abs=1)


def test_a_hanging_twig_is_no_crown() -> None:
    mask = tree(bare=40)
    mask[70:90, 40:44] = 2
    assert bare_trunk(mask) == bare_trunk(tree(bare=40))


def test_the_crown_of_a_tree_without_leaves_is_where_it_is_wide() -> None:
    assert bare_trunk(np.minimum(tree(bare=30), 1)) == pytest.approx(30, abs=1)


def test_trunk_width_is_that_of_the_bare_part() -> None:
    assert trunk_width(tree(bare=30, thick=6)) == 6
    assert trunk_width(np.full((50, 50), 2, np.uint8)) == 0


def test_errors_of_the_trunk_are_plant_less_target() -> None:
    found = agreement(tree(bare=40, thick=6), tree(bare=25, thick=4))
    assert found.bare_trunk_error == pytest.approx(-15)
    assert found.trunk_width_error == pytest.approx(-2)


def test_an_empty_plant_agrees_in_nothing_and_is_still_finite() -> None:
    found = asdict(agreement(tree(), np.zeros_like(tree())))
    assert [name for name, value in found.items() if not np.isfinite(value)] == []
    assert [found[name] for name in ("silhouette_iou", "hull_iou", "texture", "fill_ratio", "runs_ratio")] == [0] * 5
    assert found["contour_distance"] == 100


def test_a_smooth_target_has_a_finite_roughness_ratio() -> None:
    smooth = np.full((100, 64), 2, np.uint8)
    assert 1 < agreement(smooth, tree()).roughness_ratio < 1000


def test_masks_that_cannot_be_compared_are_refused() -> None:
    with pytest.raises(ValueError, match="a tree in the target"):
        agreement(np.zeros_like(ONE), ONE)
    with pytest.raises(ValueError, match="of one shape"):
        agreement(ONE, tree())


def test_the_mean_is_that_of_every_field() -> None:
    one, two = agreement(tree(30), tree(20)), agreement(tree(30), tree(50))
    mean = mean_agreement([one, two])
    assert isinstance(mean, Agreement)
    assert mean.bare_trunk_error == pytest.approx((one.bare_trunk_error + two.bare_trunk_error) / 2)
    assert mean.silhouette_iou == pytest.approx((one.silhouette_iou + two.silhouette_iou) / 2)
    assert mean_agreement([]) is None
