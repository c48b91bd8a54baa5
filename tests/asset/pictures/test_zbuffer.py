import numpy as np

from treefit.asset.pictures.pyramids import pack, pyramid
from treefit.asset.pictures.zbuffer import Holes, nearest_triangles

SQUARE = np.array([[0, 0, 1], [64, 0, 1], [64, 64, 1], [0, 64, 1]], np.float32)
HALVES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def card(alpha, cutoff=0.5, uv=((0, 1), (1, 1), (1, 0), (0, 0))):
    image = np.ones((*alpha.shape, 4), np.float32)
    image[..., 3] = alpha
    texture = np.zeros(len(HALVES), np.int32)
    limit = np.array([cutoff], np.float32)
    return Holes(np.array(uv, np.float32), texture, pack([pyramid(image, cutoff if cutoff > 0 else None)]), limit)


def test_the_nearer_triangle_is_seen():
    screen = np.array([[0, 0, 2], [8, 0, 2], [0, 8, 2], [0, 0, 1], [4, 0, 1], [0, 4, 1]], np.float32)
    seen, depth = nearest_triangles(screen, np.array([[0, 1, 2], [3, 4, 5]], np.int32), 8, 8)
    assert (seen[0, 0], seen[0, 6], seen[7, 7]) == (1, 0, -1)
    assert (depth[0, 0], depth[0, 6], depth[7, 7]) == (1, 2, np.inf)


def test_holes_are_where_the_alpha_of_the_texture_is_with_row_0_on_top():
    alpha = np.zeros((64, 64))
    alpha[:16, :32] = 1  # the upper left, v over 3/4 and u under 1/2
    seen, _ = nearest_triangles(SQUARE, HALVES, 64, 64, card(alpha))
    there = seen >= 0
    assert there[1:15, 1:31].all()
    assert not there[17:, :].any()
    assert not there[:, 33:].any()


def test_what_is_behind_shows_through_a_hole():
    screen = np.concatenate([SQUARE, SQUARE * np.array([1, 1, 2], np.float32)])
    faces = np.concatenate([HALVES, HALVES + 4])
    holes = card(np.repeat(np.tile([1, 0], (64, 8)), 4, axis=1))
    both = Holes(np.tile(holes.uv, (2, 1)), np.zeros(4, np.int32), holes.alpha, holes.cutoff)
    seen, _ = nearest_triangles(screen, faces, 64, 64, both)
    assert set(np.unique(seen)) <= {-1, 0, 1}  # both cards have their holes in the same place
    aside = np.repeat([[0.0, 0.0], [4 / 64, 0.0]], 4, axis=0).astype(np.float32)
    shifted = Holes(both.uv + aside, both.texture, both.alpha, both.cutoff)
    seen, _ = nearest_triangles(screen, faces, 64, 64, shifted)
    assert (seen >= 2).mean() > 0.4


def test_a_texture_repeats_once_a_unit_of_uv():
    alpha = np.zeros((32, 32))
    alpha[:, :16] = 1
    twice = card(alpha, uv=((-1, 1), (1, 1), (1, 0), (-1, 0)))
    there = (nearest_triangles(SQUARE, HALVES, 64, 64, twice)[0] >= 0)[32]
    np.testing.assert_array_equal(there[1:31], there[33:63])
    assert there[2:14].all()
    assert not there[18:30].any()


def test_the_share_of_holes_stays_however_small_a_card_is_drawn():
    rows, columns = np.mgrid[:256, :256]
    needles = (((columns + rows // 3) % 16) < 5).astype(float)
    for size in (128, 32, 16):
        screen = (SQUARE * [size / 64, size / 64, 1]).astype(np.float32)
        seen, _ = nearest_triangles(screen, HALVES, size, size, card(needles))
        assert abs((seen >= 0).mean() - needles.mean()) < 0.05


def test_without_a_cutoff_there_are_no_holes():
    solid = card(np.zeros((8, 8)), cutoff=-1.0)
    assert (nearest_triangles(SQUARE, HALVES, 64, 64, solid)[0] >= 0).all()
