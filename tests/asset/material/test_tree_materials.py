"""Which colours, kinds of bark and textures the materials of a tree have."""

from __future__ import annotations

import numpy as np
import pytest

from treefit.asset import AssetSettings
from treefit.asset.material.bark import bark_textures
from treefit.asset.material.colour import Colour, to_linear, to_linear_light
from treefit.asset.material.material import Material
from treefit.asset.material.tree_materials import TreeColours, bark_kind, tree_materials

SEEN = TreeColours((120, 100, 80), (221, 119, 63))


def shown(material: Material) -> np.ndarray:
    """Linear mean of what the material shows."""
    if material.base is None:
        return to_linear(material.colour)
    base = material.base
    there = base[..., 3] >= 255 * material.cutoff if material.cutoff is not None else np.ones(base.shape[:2], bool)
    return to_linear_light(base[there][:, :3] / 255).mean(axis=0) * to_linear(material.colour)


@pytest.mark.parametrize("size", [0, 64])
def test_the_users_colour_wins_over_the_pictures_and_that_over_ours(size: int) -> None:
    def leaf(seen: TreeColours | None, **chosen: object) -> np.ndarray:
        return shown(tree_materials(AssetSettings(texture_size=size, **chosen), "broad", seen)["leaves"])

    own, red = leaf(None), leaf(SEEN)
    np.testing.assert_allclose(red, to_linear((221, 119, 63)), rtol=0.02, atol=0.002)
    np.testing.assert_allclose(leaf(SEEN, leaf="#203040"), to_linear((32, 48, 64)), rtol=0.03, atol=0.002)
    np.testing.assert_array_equal(leaf(SEEN, colours="own"), own)
    np.testing.assert_array_equal(leaf(TreeColours(bark=(1, 2, 3))), own)
    assert own[1] > own[0] > own[2]


def test_needles_and_scales_are_darker_than_broad_leaves() -> None:
    light = {
        shape: shown(tree_materials(AssetSettings(texture_size=0), shape)["leaves"]).sum()
        for shape in ("broad", "tuft", "scale")
    }
    assert max(light["tuft"], light["scale"]) < 0.75 * light["broad"]


def test_leaves_have_holes_and_two_sides_and_bark_has_neither() -> None:
    materials = tree_materials(AssetSettings(texture_size=64), "oak")
    leaves, bark = materials["leaves"], materials["bark"]
    assert leaves.two_sided
    assert leaves.cutoff is not None
    assert leaves.base is not None
    assert leaves.base.shape == (64, 64, 4)
    assert not bark.two_sided
    assert bark.cutoff is None
    assert bark.base is not None
    assert bark.base.shape == (64, 64, 3)


def test_size_zero_means_no_textures() -> None:
    for material in tree_materials(AssetSettings(texture_size=0), "tuft").values():
        assert material.base is material.normal is material.roughness is material.cutoff is None


@pytest.mark.parametrize(
    ("colour", "kind"),
    [((215, 208, 196), "ringed"), ((150, 100, 72), "plated"), ((150, 146, 138), "smooth"), ((112, 88, 68), "furrowed"),
     ((70, 60, 50), "furrowed")],
)  # fmt: skip
def test_the_kind_of_bark_follows_its_colour(colour: Colour, kind: str) -> None:
    assert bark_kind(colour) == kind
    assert tree_materials(AssetSettings(bark=colour, texture_size=64), "broad")["bark"].base is not None


def test_a_kind_of_bark_that_the_user_names_wins() -> None:
    bark = tree_materials(AssetSettings(bark_kind="ringed", texture_size=64), "broad")["bark"]
    assert bark.normal is bark_textures("ringed", 64).normal
