from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.zbuffer_view import zbuffer_mask
from treefit.plant import Plant
from treefit.view import BitMask, Frame, OrthographicView

FRAME = Frame(128, 4)


@pytest.mark.slow
def test_the_silhouette_is_that_of_the_slow_view_to_the_pixel_edge(plants: list[Plant]) -> None:
    for plant in plants:
        fast, slow = OrthographicView()(plant, FRAME).unpack() > 0, zbuffer_mask(plant, FRAME) > 0
        assert (fast != slow).sum() <= 0.005 * slow.sum() + 2  # centres that rounding puts on the other side


def test_half_a_turn_mirrors_the_silhouette(plants: list[Plant]) -> None:
    for plant in plants[:4]:
        front = OrthographicView()(plant, FRAME).unpack() > 0
        back = OrthographicView(azimuth=180.0)(plant, FRAME).unpack() > 0
        assert (front != back[:, ::-1]).sum() <= 0.01 * front.sum() + 4


def test_every_side_is_that_of_a_view_turned_there(plants: list[Plant]) -> None:
    """Opposite sides are drawn together: centres on an edge may fall to the other side."""
    for count in (1, 2, 3, 4):
        sides = OrthographicView(azimuth=20.0, azimuths=count).sides(plants[0], FRAME)
        assert len(sides) == count
        for i, side in enumerate(sides):
            alone = OrthographicView(azimuth=20.0 + 360.0 * i / count)(plants[0], FRAME).unpack()
            assert ((side.unpack() > 0) != (alone > 0)).sum() <= 0.005 * (alone > 0).sum() + 4
            assert (side.unpack() != alone).sum() <= 0.03 * (alone > 0).sum() + 4


def test_masks_stay_when_other_plants_are_drawn(plants: list[Plant]) -> None:
    view = OrthographicView()
    first = view(plants[0], FRAME)
    kept = first.unpack()
    for plant in plants[1:]:
        view(plant, FRAME)
    assert (first.unpack() == kept).all()
    assert (view(plants[0], FRAME).unpack() == kept).all()


def test_numbers_far_out_of_the_frame_draw_nothing_and_do_no_harm(plants: list[Plant]) -> None:
    plant = plants[0]
    far = replace(plant, leaf_position=plant.leaf_position.copy())
    far.leaf_position[::2, :2] = 1e30
    assert OrthographicView()(far, FRAME).unpack().any()


def test_the_plant_fills_the_height_and_stands_in_the_middle(plants: list[Plant]) -> None:
    for plant in plants:
        mask = OrthographicView()(plant, FRAME).unpack()
        assert mask[:16].any()  # the tip of a thin twig may miss all the centres of several rows
        assert mask[-4:].any()
        assert mask[-4:, FRAME.width // 2 - 3 : FRAME.width // 2 + 3].any()


def test_a_plant_wider_than_the_frame_is_clipped_at_its_edges(plants: list[Plant]) -> None:
    wide = max(plants, key=lambda plant: float(np.abs(plant.position[:, 0]).max() / plant.position[:, 2].max()))
    whole = OrthographicView()(wide, Frame(128, 8)).unpack()
    part = OrthographicView()(wide, Frame(128, 1)).unpack()
    assert (part == whole[:, 8 * 32 - 32 : 8 * 32 + 32]).all()


def test_bit_rows_give_back_their_mask() -> None:
    mask = np.random.default_rng(1).integers(0, 3, (20, 192)).astype(np.uint8)
    assert (BitMask.pack(mask).unpack() == mask).all()
    with pytest.raises(ValueError, match="multiple of 64"):
        BitMask.pack(mask[:, :100])


def test_a_resolution_out_of_range_is_refused() -> None:
    with pytest.raises(ValueError, match="greater than or equal to 16"):
        OrthographicView(resolution=3)
