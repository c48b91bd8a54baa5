"""What bark and leaf textures are like: their mean, their seams, their alpha, their normals."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from scipy.ndimage import binary_dilation

from treefit.asset.material.bark import bark_textures
from treefit.asset.material.colour import Colour, to_linear, to_linear_light
from treefit.asset.material.leaf import leaf_textures
from treefit.asset.material.texture import CUTOFF, Drawing, Textures, textures_of
from treefit.asset.mesh.leaf_outline import leaf_card
from treefit.asset.settings import BarkKind
from treefit.plant import LEAF_SHAPES
from treefit.plant.look import SPRIGS

KINDS = [kind for kind in get_args(BarkKind) if kind != "auto"]
COLOURS: list[Colour] = [(112, 88, 68), (221, 119, 63), (215, 208, 196), (20, 24, 18), (255, 255, 255), (0, 0, 0)]
SIZE = 128
barks = pytest.mark.parametrize("kind", KINDS)
leaves = pytest.mark.parametrize("shape", LEAF_SHAPES)


def all_textures() -> list[Textures]:
    return [*(bark_textures(kind, SIZE) for kind in KINDS), *(leaf_textures(shape, SIZE) for shape in LEAF_SHAPES)]


def there(base: np.ndarray) -> np.ndarray:
    return base[..., 3] >= 255 * CUTOFF if base.shape[2] == 4 else np.ones(base.shape[:2], bool)


@pytest.mark.parametrize("wished", COLOURS)
def test_colour_times_texture_has_the_wished_mean(wished: Colour) -> None:
    for textures in all_textures():
        colour, base = textures.coloured(wished)
        mean = (to_linear_light(base[there(base)][:, :3] / 255) * to_linear(colour)).mean(axis=0)
        np.testing.assert_allclose(mean, to_linear(wished), rtol=0.02, atol=0.002)


def test_textures_are_neither_flat_nor_dark() -> None:
    for textures in all_textures():
        light = to_linear_light(textures.base[there(textures.base)][:, :3] / 255).mean(axis=1)
        assert 0.4 < light.mean() < 0.85
        assert light.std() / light.mean() > 0.05


def test_a_texture_keeps_its_contrast_under_usual_colours() -> None:
    for textures in all_textures():
        assert textures.coloured((112, 88, 68))[1] is textures.base


@barks
def test_bark_has_no_seam(kind: str) -> None:
    textures = bark_textures(kind, SIZE)
    for texels in (textures.base, textures.normal, textures.roughness):
        for axis in (0, 1):
            steps = np.abs(np.diff(texels.astype(float), axis=axis, append=texels.take([0], axis).astype(float)))
            inner = steps.mean(axis=tuple(i for i in range(texels.ndim) if i != axis))
            assert inner[-1] <= 1.5 * inner[:-1].max()


@barks
def test_bark_repeats_unseen(kind: str) -> None:
    """No eighth of the tile is much lighter or darker than the others."""
    light = bark_textures(kind, SIZE).base.mean(axis=2).reshape(8, SIZE // 8, 8, SIZE // 8).mean(axis=(1, 3))
    assert light.std() < 0.08 * light.mean()


def test_kinds_of_bark_run_their_own_way() -> None:
    def grain(kind: str) -> float:
        light = bark_textures(kind, 512).base.mean(axis=2)
        return float(np.abs(np.diff(light, axis=1)).mean() / np.abs(np.diff(light, axis=0)).mean())

    assert grain("furrowed") > 1.4
    assert 0.8 < grain("plated") < 1.4
    assert grain("ringed") < 0.7


def test_normals_lean_away_from_a_hill_with_green_up() -> None:
    away = (np.indices((64, 64)) - 31.5) / 64
    height = np.exp(-40 * (away**2).sum(axis=0)).astype(np.float32)
    flat = np.ones((64, 64), np.float32)
    normal = textures_of(Drawing(flat[..., None].repeat(3, 2), height, flat)).normal.astype(int) - 128
    left, right, top, bottom = normal[32, 22], normal[32, 42], normal[22, 32], normal[42, 32]
    assert left[0] < -60 < 60 < right[0]
    assert bottom[1] < -60 < 60 < top[1]


def test_normals_are_of_unit_length_and_flat_on_the_whole() -> None:
    for textures in all_textures():
        normal = textures.normal / 127.5 - 1
        np.testing.assert_allclose(np.linalg.norm(normal, axis=2), 1, atol=0.02)
        assert normal[..., 2].min() >= 0
        np.testing.assert_allclose(normal[..., :2].mean(axis=(0, 1)), 0, atol=0.02)


@leaves
def test_the_mesh_of_a_leaf_lies_in_its_alpha(shape: str) -> None:
    """Most of each leaf's mesh shows something, and little of the leaf is outside of it."""
    alpha = leaf_textures(shape, 256).base[..., 3] >= 255 * CUTOFF
    card = leaf_card(shape)
    inside = np.zeros_like(alpha)
    weights = np.random.default_rng(0).dirichlet([1, 1, 1], 3000)
    for face in card.faces:
        u, v = (weights @ card.uv[face]).T
        inside[((1 - v) * 256).astype(int), (u * 256).astype(int)] = True
    inside = binary_dilation(inside)
    assert (alpha & inside).sum() > 0.66 * inside.sum()
    if shape != "tuft":  # its needles stand all around
        assert (alpha & inside).sum() > 0.6 * alpha.sum()


@leaves
def test_a_leaf_ends_before_the_border_of_its_texture(shape: str) -> None:
    alpha = leaf_textures(shape, SIZE).base[..., 3]
    assert max(alpha[0].max(), alpha[:, 0].max(), alpha[:, -1].max(), alpha[-1].max()) == 0
    low = np.nonzero(alpha[-SIZE // 8 :].max(axis=0) >= 255 * CUTOFF)[0]
    assert len(low) > 0  # its stalk comes from the middle below
    assert np.abs(low - SIZE / 2).min() <= 1.5


@leaves
def test_colours_go_on_beyond_the_alpha(shape: str) -> None:
    """What a coarser level mixes in from around the leaf is the leaf's own colour."""
    base = leaf_textures(shape, SIZE).base
    seen = base[..., 3] > 0
    around = binary_dilation(seen, iterations=3) & ~seen
    inner, outer = base[seen][:, :3].mean(axis=0), base[around][:, :3].mean(axis=0)
    assert np.abs(inner - outer).max() < 40


@pytest.mark.parametrize("shape", SPRIGS.values())
def test_a_sprig_is_leaves_on_a_twig_of_wood(shape: str) -> None:
    base = leaf_textures(shape, 256).base
    red, green, _, alpha = base.astype(float).transpose(2, 0, 1)
    there = alpha >= 255 * CUTOFF
    twig = there & (np.indices(there.shape)[0] > 0.92 * 256)
    assert twig.any()
    assert np.median((red / green)[twig]) > 1.2 * np.median((red / green)[there])
    leaves = there & ~binary_dilation(twig, iterations=3)
    inner = np.array([np.diff(np.flatnonzero(row)).max(initial=1) for row in leaves])
    assert (inner > 1).sum() > 20  # there are gaps between leaves


@pytest.mark.parametrize("size", [1, 64, 100])
def test_textures_have_the_size_that_is_asked_for(size: int) -> None:
    for textures in (bark_textures("plated", size), *(leaf_textures(one, size) for one in ("tuft", "oak", "sprig"))):
        assert textures.base.shape[:2] == textures.normal.shape[:2] == textures.roughness.shape == (size, size)


def test_the_same_texture_has_the_same_bytes() -> None:
    for make, name in ((bark_textures, "furrowed"), (leaf_textures, "tuft"), (leaf_textures, "sprig")):
        one, two = make(name, SIZE), make.__wrapped__(name, SIZE)
        for part in ("base", "normal", "roughness"):
            assert getattr(one, part).tobytes() == getattr(two, part).tobytes()
