"""WeberPennGen: what each group of parameters does to stems and leaves."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from scripts.census import begins
from tests.generators.regular_trees import CROWNED, GENERATOR, STRAIGHT, directions, grow, length, stems, wood
from treefit.plant import Budget, Plant, Value


def azimuths(plant: Plant) -> NDArray[np.float64]:
    """Degrees around the vertical of the first segments of the stems of level 1."""
    first = np.array([directions(path)[0] for path in stems(plant, 1)])
    return np.degrees(np.arctan2(first[:, 1], first[:, 0]))


def apart(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Degrees from each angle to the next, in [0, 360)."""
    return np.diff(angles) % 360


def test_children_go_around_by_rotate() -> None:
    assert apart(azimuths(grow(STRAIGHT, rotate_1=50))) == pytest.approx(50, abs=0.1)


def test_children_alternate_between_two_sides_for_a_negative_rotate() -> None:
    steps = apart(azimuths(grow(STRAIGHT, rotate_1=-100)))
    assert steps[::2] == pytest.approx(steps[0], abs=0.1)
    assert steps[1::2] == pytest.approx(360 - steps[0], abs=0.1)
    assert min(steps[0], 360 - steps[0]) == pytest.approx(2 * (180 - 100), abs=0.1)


def test_whorls_are_evenly_spread() -> None:
    plant = grow(STRAIGHT, branches_1=12, whorl_1=4, rotate_1=30)
    heights = np.array([path[0, 2] for path in stems(plant, 1)]).reshape(3, 4)
    assert np.ptp(heights, axis=1) == pytest.approx(0, abs=1e-4)
    assert np.diff(heights[:, 0]).min() > 2
    turns = azimuths(plant).reshape(3, 4)
    assert np.diff(turns, axis=1) % 360 == pytest.approx(90, abs=0.1)
    assert apart(turns[:, 0]) == pytest.approx(30, abs=0.1)


def test_negative_counts_stand_in_a_fan_at_the_tip() -> None:
    plant = grow(STRAIGHT, branches_1=-5, down_angle_1=0, rotate_1=100, leaves=-7, rotate_2=90, down_angle_2=0)
    paths = stems(plant, 1)
    assert len(paths) == 5
    assert np.array([path[0] for path in paths]) == pytest.approx(np.tile([0, 0, 10], (5, 1)), abs=1e-3)
    assert angles_along([directions(path)[0] for path in paths]) == pytest.approx([25, 50, 75, 100], abs=0.1)
    leaves = plant.leaf_axis.reshape(5, 7, 3)
    tips = [path[-1] for path in paths]
    assert plant.leaf_position.reshape(5, 7, 3) == pytest.approx(np.repeat(tips, 7, 0).reshape(5, 7, 3), abs=1e-3)
    for fan in leaves:
        assert angles_along(fan) == pytest.approx(np.arange(15, 91, 15), abs=0.1)


def angles_along(units: list[NDArray[np.float32]] | NDArray[np.float32]) -> NDArray[np.float64]:
    """Degrees from the first of some unit vectors to each of the others."""
    return np.degrees(np.arccos(np.clip(np.asarray(units)[1:] @ units[0], -1, 1)))


@pytest.mark.parametrize(("level", "angle"), [(0, 30), (0, 70), (1, 50)])
def test_a_negative_curve_v_is_a_helix_around_the_way_of_the_stem(level: int, angle: int) -> None:
    plant = grow(STRAIGHT, **{f"curve_v_{level}": -angle, f"curve_res_{level}": 12})
    straight = [directions(path)[0] for path in stems(grow(STRAIGHT), level)]
    for path, axis in zip(stems(plant, level), straight, strict=True):
        units = directions(path)[-8:]  # the trunk's first segment has more vertices
        assert units @ axis == pytest.approx(np.cos(np.radians(angle)), abs=2e-3)
        assert units[4:] == pytest.approx(units[:4], abs=2e-3)  # four quarters around
        around = units - np.outer(units @ axis, axis)
        assert (around[1:] * around[:-1]).sum(axis=1) == pytest.approx(0, abs=5e-3)


@pytest.mark.parametrize(
    ("taper", "radii"),
    [
        (0.0, [1] * 11),
        (0.5, [1 - 0.05 * z for z in range(11)]),
        (1.0, [1 - 0.1 * z for z in range(11)]),
        (2.0, [*[1] * 10, 0]),
        (3.0, [1, *[1, 0] * 5]),
    ],
)
def test_a_taper_is_a_cylinder_a_cone_a_rounded_end_or_spheres(taper: float, radii: list[float]) -> None:
    plant = grow(STRAIGHT, branches_1=0, taper_0=taper, ratio=0.1, curve_res_0=10)
    assert plant.radius == pytest.approx(radii, abs=1e-3)


def test_a_rounded_end_is_half_a_sphere() -> None:
    plant = grow(STRAIGHT, branches_1=0, taper_0=2, ratio=0.1, curve_res_0=40)
    left = 10 - plant.position[:, 2]
    assert plant.radius == pytest.approx(np.sqrt(1 - np.clip(1 - left, 0, 1) ** 2), abs=1e-2)


def test_the_flare_widens_the_foot_and_stops_at_an_eighth_of_the_trunk() -> None:
    plain = grow(STRAIGHT, branches_1=0, curve_res_0=3)
    assert plain.n_vertices == 4
    foot = grow(STRAIGHT, branches_1=0, curve_res_0=3, flare=0.8)
    z = foot.position[:, 2].astype(np.float64) / 10
    assert z == pytest.approx([0, 1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 3, 2 / 3, 1], abs=1e-5)
    wider = 1 + 0.8 * (100 ** np.maximum(0, 1 - 8 * z) - 1) / 100
    assert foot.radius == pytest.approx(0.15 * (1 - z) * wider, abs=1e-5)
    assert (wider[z >= 0.125] == 1).all()


ENVELOPE: dict[str, Value] = {
    "prune_width": 0.25, "prune_width_peak": 0.4, "prune_power_low": 0.6, "prune_power_high": 0.8,
}  # fmt: skip


@pytest.mark.parametrize("splits", [0.0, 0.3])
def test_pruned_stems_are_inside_the_envelope(splits: float) -> None:
    plain = grow(CROWNED, length_1=0.5, seg_splits_1=splits)
    plant = grow(CROWNED, length_1=0.5, seg_splits_1=splits, prune_ratio=1, **ENVELOPE)
    assert outside(plain) > 0.3
    assert outside(plant) == 0
    assert (reach(plant) > 0.95).sum() > 10  # and come close to it


def outside(plant: Plant) -> float:
    """Share of the vertices of branches that are not within the envelope."""
    return float((reach(plant) > 1.001).mean())


def reach(plant: Plant) -> NDArray[np.float64]:
    """Distance of the vertices of branches from the trunk's axis by the radius of the envelope at their height."""
    x, y, z = plant.position[plant.level > 0].astype(np.float64).T
    r = np.clip((12 - z) / (12 * (1 - 0.2)), 0, 1)
    ratio = np.where(r < 1 - 0.4, (r / (1 - 0.4)) ** 0.8, ((1 - r) / 0.4) ** 0.6)  # sec. 4.7
    return np.hypot(x, y) / (12 * 0.25 * ratio + 1e-6)


def test_prune_ratio_is_the_share_of_the_shortening() -> None:
    one, half, all_ = (
        np.array([length(path) for path in stems(grow(CROWNED, prune_ratio=ratio, **ENVELOPE), 1)])
        for ratio in (0, 0.5, 1)
    )
    assert (all_ < 0.9 * one).any()
    assert half == pytest.approx((one + all_) / 2, rel=1e-3)


def test_without_a_prune_ratio_the_envelope_does_nothing() -> None:
    assert wood(grow(CROWNED)) == wood(grow(CROWNED, **ENVELOPE))


def test_attraction_raises_stems_from_level_2_on_or_lowers_them() -> None:
    plants = [grow(CROWNED, attraction_up=attraction) for attraction in (-3, -1, 0, 1, 3)]
    rise = [np.mean([directions(path)[-1, 2] for path in stems(plant, 2)]) for plant in plants]
    assert all(two > one + 0.05 for one, two in itertools.pairwise(rise))
    assert rise[0] < -0.7
    assert rise[-1] > 0.7
    assert len({wood(plant, 2) for plant in plants}) == 1


def test_leaf_bend_turns_leaves_to_the_light() -> None:
    plants = [grow(CROWNED, leaves=8, leaf_bend=bend) for bend in (0, 0.3, 0.6, 1)]
    up = [float(plant.leaf_normal[:, 2].mean()) for plant in plants]
    assert all(two > one + 0.05 for one, two in itertools.pairwise(up))
    assert plants[-1].leaf_normal[:, 2].min() > 0.99
    out = [(plant.leaf_normal * plant.leaf_position)[:, :2].sum(axis=1).mean() for plant in plants[:2]]
    assert out[1] > out[0]


@pytest.mark.parametrize("levels", [2, 3, 4])
def test_leaves_grow_on_the_stems_of_the_last_level(levels: int) -> None:
    plant = grow(CROWNED, levels=levels, leaves=6, branches_3=4)
    assert set(plant.level) == set(range(levels))
    last = np.flatnonzero(plant.level == levels - 1)
    last = last[~begins(plant)[last]]
    tip, base = plant.position[last], plant.position[plant.parent[last]]
    for place in plant.leaf_position[:50]:
        along = np.clip(((place - base) * (tip - base)).sum(1) / ((tip - base) ** 2).sum(1), 0, 1)
        assert np.linalg.norm(base + along[:, None] * (tip - base) - place, axis=1).min() < 1e-3


def test_deeper_levels_leave_the_wood_below_as_it_was() -> None:
    plants = [grow(CROWNED, levels=levels, branches_3=3) for levels in (2, 3, 4)]
    assert len({wood(plant, 2) for plant in plants}) == 1
    assert wood(plants[1], 3) == wood(plants[2], 3)


@pytest.mark.parametrize(
    "changed",
    [{"leaves": 3}, {"leaves": -9}, {"leaf_scale": 0.5}, {"leaf_bend": 1.0}, {"down_angle_3": 80}, {"lobes": 2}],
    ids=str,
)
def test_wood_is_the_same_whatever_the_leaves_do(changed: dict[str, Value]) -> None:
    assert wood(grow(CROWNED, leaves=10)) == wood(grow(CROWNED, **{"leaves": 10, **changed}))


@pytest.mark.parametrize(
    "changed", [{"branches_2": 5}, {"length_2": 0.3}, {"curve_v_2": 90}, {"rotate_v_2": 50}], ids=str
)
def test_a_level_is_the_same_whatever_those_above_do(changed: dict[str, Value]) -> None:
    one, two = grow(CROWNED), grow(CROWNED, **changed)
    assert wood(one, 2) == wood(two, 2)
    assert wood(one, 3) != wood(two, 3)


def test_more_children_leave_the_way_of_each_as_it_was() -> None:
    """Draws are of the place in the tree, not of how many came before."""
    one, two = (stems(grow(CROWNED, levels=2, branches_1=count, shape=3), 1) for count in (20, 40))
    bends = [np.array([directions(path) @ directions(path)[0] for path in paths[:20]]) for paths in (one, two)]
    assert bends[0] == pytest.approx(bends[1], abs=1e-3)


def test_helices_of_many_segments_keep_their_frames() -> None:
    """Errors of length must not double from segment to segment and from level to level."""
    helices = {f"{name}_{n}": value for n in range(3) for name, value in (("curve_v", -110), ("curve_res", 20))}
    plant = grow(CROWNED, leaves=5, **helices)
    np.testing.assert_allclose(np.linalg.norm(plant.leaf_axis, axis=1), 1, atol=1e-3)


def test_clones_fill_a_budget_to_the_vertex() -> None:
    """Stems that all but the last segment doubles have few vertices of their own: room is kept for as many clones."""
    values = {**STRAIGHT, "base_splits": 3, "seg_splits_0": 1.5, "curve_res_0": 9, "branches_1": 0}
    whole = grow(values)
    assert whole.n_vertices > 5_000
    for spare in (0, 1):
        plant = GENERATOR(GENERATOR.space.complete(values), 1, Budget(whole.n_vertices - spare, 10))
        assert plant.n_vertices <= whole.n_vertices - spare
        assert plant.cut == bool(spare)
