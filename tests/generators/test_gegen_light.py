"""Light of GEGen: shade is a sum of pyramids below the leaves, and a crown is darker the deeper in it."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray
from scipy.stats import spearmanr

from generators.gegen.field import CELLS, FADE, HIGH, WIDE, cast, enclose, light_at, propagate
from generators.gegen.tree import X, Y, Z
from tests.generators.grown import OPEN, Grown, grow, random_values

SLOPES = [(0.0, 0.0), (0.4, 0.0), (-0.7, 0.0), (0.3, -0.5), (0.7, 0.7)]
MIDDLE = WIDE / 2
WHOLE = np.array([1, WIDE - 1, 1, WIDE - 1, HIGH - 1])
Grid = NDArray[np.float32]  # (HIGH, WIDE, WIDE): z, y, x


@njit
def _shade(source, box, slope_x, slope_y):
    shade, rows = np.zeros_like(source), np.zeros((2 * WIDE, WIDE + 2), np.float32)
    propagate(source, shade, rows, box, slope_x, slope_y)
    return shade


@njit
def _cast(places, amount):
    source = np.zeros((HIGH, WIDE, WIDE), np.float32)
    for x, y, z in places:
        cast(source, x, y, z, np.float32(1.0), amount)
    return source


@njit
def _lights(shade, places):
    return np.array([light_at(shade, x, y, z, np.float32(1.0)) for x, y, z in places])


@njit
def _enclose(joint, scale):
    box = np.array([WIDE, 0, WIDE, 0, 0])
    enclose(joint, len(joint), scale, box)
    return box


def shade_of(source: Grid, slope: tuple[float, float] = (0, 0), box: NDArray[np.int64] = WHOLE) -> Grid:
    shade: Grid = _shade(source, box, np.float32(slope[0]), np.float32(slope[1]))
    return shade


def leaves(count: int, seed: int = 0, amount: float = 1.0) -> Grid:
    """Source of leaves at random places in the middle of the grid."""
    rng = np.random.default_rng(seed)
    source: Grid = _cast(rng.uniform((-6, -6, 4), (6, 6, HIGH - 4), (count, 3)).astype(np.float32), np.float32(amount))
    return source


def width(layer: NDArray[np.float32]) -> float:
    """Deviation of the shade in a layer from its middle, by x and y together, in voxels."""
    rows, columns = np.indices(layer.shape) + 0.5
    weights = layer / layer.sum()
    x, y = (columns * weights).sum(), (rows * weights).sum()
    return float(np.sqrt((((columns - x) ** 2 + (rows - y) ** 2) * weights).sum()))


def test_a_leaf_casts_all_of_its_shade_around_its_place_in_its_layer() -> None:
    place = np.array([[1.3, -2.6, 9.2]], np.float32)
    source = _cast(place, np.float32(0.7))
    assert source.sum() == pytest.approx(0.7, rel=1e-5)
    z, y, x = ((np.indices(source.shape) + 0.5) * source).sum(axis=(1, 2, 3)) / source.sum()
    assert (x - MIDDLE, y - MIDDLE, z) == pytest.approx((*place[0, :2], 9.5), abs=1e-3)


@pytest.mark.parametrize("slope", SLOPES)
def test_below_a_leaf_is_a_pyramid_that_widens_and_fades(slope: tuple[float, float]) -> None:
    source = np.zeros((HIGH, WIDE, WIDE), np.float32)
    top, depth = 20, 14
    source[top, WIDE // 2, WIDE // 2] = 1
    shade = shade_of(source, slope)
    assert not shade[top:].any()
    below = shade[top - depth : top][::-1]
    assert below.sum(axis=(1, 2)) == pytest.approx(float(FADE) ** np.arange(1, depth + 1), rel=1e-4)
    widths = [width(layer) for layer in below]
    assert (np.diff(widths) > 0).all()
    assert widths[-1] == pytest.approx(np.sqrt(depth), rel=1e-3)  # half a voxel of variance a layer in x and in y


@pytest.mark.parametrize("slope", SLOPES)
def test_light_from_one_side_shears_the_pyramid_to_the_other(slope: tuple[float, float]) -> None:
    source = np.zeros((HIGH, WIDE, WIDE), np.float32)
    source[20, WIDE // 2, WIDE // 2] = 1
    shade = shade_of(source, slope)
    rows, columns = np.indices(shade[0].shape)
    for down in range(1, 15):
        layer = shade[20 - down] / shade[20 - down].sum()
        middle = ((columns * layer).sum() - WIDE // 2, (rows * layer).sum() - WIDE // 2)
        assert middle == pytest.approx((-slope[0] * down, -slope[1] * down), abs=1e-2)


@pytest.mark.parametrize("slope", SLOPES)
def test_the_shade_of_two_is_the_sum_of_their_shades(slope: tuple[float, float]) -> None:
    one, two = leaves(30, 1), leaves(50, 2)
    np.testing.assert_allclose(
        shade_of(one + two, slope), shade_of(one, slope) + shade_of(two, slope), rtol=1e-4, atol=1e-5
    )
    np.testing.assert_allclose(shade_of(3 * one, slope), 3 * shade_of(one, slope), rtol=1e-4, atol=1e-5)


def test_nothing_is_outside_the_box_and_inside_all_that_stays_in_it() -> None:
    source = leaves(40)
    box = np.array([12, 33, 13, 31, 20])
    source[20:] = 0
    shade = shade_of(source, (0.3, 0), box)
    assert (shade >= 0).all()
    inside = np.zeros_like(shade, bool)
    inside[: box[4], box[2] : box[3], box[0] : box[1]] = True
    assert shade[inside].any()
    assert not shade[~inside].any()
    assert (shade <= shade_of(source, (0.3, 0)) + 1e-5).all()


def test_the_box_holds_every_joint_and_never_leaves_the_grid() -> None:
    rng = np.random.default_rng(2)
    for size in (1, 5, 30):
        joint = np.zeros((50, Z + 1), np.float32)
        joint[:, [X, Y]] = rng.normal(0, size, (50, 2))
        joint[:, Z] = np.abs(rng.normal(0, size, 50))
        x0, x1, y0, y1, top = _enclose(joint, np.float32(1.0))
        assert 1 <= x0 < x1 <= WIDE - 1
        assert 1 <= y0 < y1 <= WIDE - 1
        assert 1 <= top <= HIGH - 1
        for (low, high), row in zip([(x0, x1), (y0, y1)], (joint[:, X], joint[:, Y]), strict=True):
            within = np.clip(row + MIDDLE, 1, WIDE - 2)
            assert (within >= low).all()
            assert (within <= high).all()


@pytest.mark.parametrize("slope", SLOPES)
@pytest.mark.parametrize("amount", [0.0, 0.01, 0.3, 100.0])
def test_light_is_never_below_0_nor_above_1(amount: float, slope: tuple[float, float]) -> None:
    shade = shade_of(leaves(300, amount=amount), slope)
    light = _lights(shade, np.random.default_rng(3).uniform(-60, 60, (5_000, 3)).astype(np.float32))
    assert (light >= 0).all()
    assert light.max() == pytest.approx(1, abs=1e-6)
    assert (light.min() < 1) == (amount > 0)


def test_more_leaves_nowhere_make_more_light() -> None:
    places = np.random.default_rng(3).uniform((-20, -20, 0), (20, 20, 25), (5_000, 3)).astype(np.float32)
    few, many = (_lights(shade_of(source), places) for source in (leaves(40), leaves(40) + leaves(40, 1)))
    assert (many <= few + 1e-6).all()
    assert (many < few).any()


def test_light_falls_with_depth_in_the_crown() -> None:
    seen = 0
    for values in random_values(24, internodes=3000, shade=0.3, **OPEN):
        tree = grow(**values)
        crown = ~tree.lost & tree.leafy(2)
        if crown.sum() < 200:
            continue
        deep, light = depths(tree, float(values["leader"]))[crown], tree.light[crown]
        assert spearmanr(deep, light).statistic < -0.6
        outer, middle, inner = (light[part].mean() for part in np.array_split(np.argsort(deep), 3))
        assert outer > middle > inner
        seen += 1
    assert seen >= 5


def depths(tree: Grown, leader: float) -> NDArray[np.float64]:
    """Voxels from each joint up to the highest one that is not lost and less than a voxel beside it (n,)."""
    x, y, z = (tree.joint[[X, Y, Z]] * CELLS / leader).astype(np.float64)
    above = (np.hypot(x - x[:, None], y - y[:, None]) < 1) & ~tree.lost
    return np.where(above, z, 0).max(axis=1) - z
