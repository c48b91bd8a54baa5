"""Levels of detail of a tree: their counts, their silhouettes, and what they keep of the whole model."""

import dataclasses

import numpy as np
import pytest

from tests.asset.conftest import make_tree
from treefit.asset import AssetSettings
from treefit.asset.formats.mesh_check import check_models
from treefit.asset.lod.levels import Level, levels_of
from treefit.asset.model import model_of
from treefit.plant import Plant


@pytest.fixture(scope="module")
def small() -> Plant:
    return make_tree(branches=18, twigs=6, leaves=1500)


@pytest.fixture(scope="module")
def levels(small: Plant) -> list[Level]:
    return levels_of(small, AssetSettings(texture_size=64))


def _bare(plant: Plant) -> Plant:
    none = np.zeros((0, 3), np.float32)
    return dataclasses.replace(
        plant, leaf_position=none, leaf_axis=none, leaf_normal=none, leaf_size=np.zeros((0, 2), np.float32)
    )


def test_levels_are_named_as_engines_expect(levels):
    assert [level.model.name for level in levels] == ["tree_LOD0", "tree_LOD1", "tree_LOD2", "tree_LOD3"]
    assert [level.wanted for level in levels] == [1.0, 0.4, 0.15, "billboard"]


def test_a_level_has_nearly_the_triangles_that_it_may_have(levels):
    whole = levels[0].triangles
    for level in levels[1:3]:
        assert 0.97 * level.wanted * whole <= level.triangles <= level.wanted * whole


def test_counts_are_those_of_the_meshes(levels):
    for level in levels:
        meshes = [part.mesh for part in level.model.parts.values()]
        assert level.triangles == sum(len(mesh.faces) for mesh in meshes)
        assert level.vertices == sum(len(mesh.vertices) for mesh in meshes)


def test_silhouettes_stay(levels):
    assert levels[0].silhouette_iou == 1
    assert levels[1].silhouette_iou > 0.89  # a thin crown: hardly a leaf hides another
    assert levels[2].silhouette_iou > 0.78
    assert levels[3].silhouette_iou > 0.4


def test_counts_of_triangles_are_kept_as_well_as_shares(small):
    levels = levels_of(small, AssetSettings(texture_size=64, lods=(9000, 3000, 600)))
    for level in levels:
        assert 0.97 * level.wanted <= level.triangles <= level.wanted
    assert [level.silhouette_iou for level in levels] == sorted(
        (level.silhouette_iou for level in levels), reverse=True
    )


def test_a_count_that_the_plant_does_not_need_is_the_whole_model(small, levels):
    (level,) = levels_of(small, AssetSettings(texture_size=64, lods=(10**6,)))
    assert level.triangles == levels[0].triangles
    assert level.silhouette_iou == 1


def test_without_levels_there_is_the_whole_model(small, levels):
    (level,) = levels_of(small, AssetSettings(texture_size=64, lods=()))
    assert (level.model.name, level.wanted, level.triangles) == ("tree_LOD0", 1.0, levels[0].triangles)


def test_the_fewest_triangles_are_those_of_the_trunk(small):
    (level,) = levels_of(small, AssetSettings(texture_size=64, lods=(2,)))
    assert set(level.model.parts) == {"trunk"}
    assert level.triangles <= 12


def test_all_levels_can_be_written(levels):
    check_models([level.model for level in levels], "test")


def test_levels_have_the_materials_and_the_places_of_the_whole_model(levels):
    whole = levels[0].model.parts
    for level in levels[1:3]:
        assert set(level.model.parts) == set(whole)
        for name, part in level.model.parts.items():
            assert part.material is whole[name].material
            extents = [np.ptp(mesh.vertices, axis=0) for mesh in (part.mesh, whole[name].mesh)]
            assert np.allclose(*extents, rtol=0.2)


def test_leaves_are_lit_as_those_of_the_whole_model(levels):
    means = [level.model.parts["leaves"].mesh for level in levels[:3]]
    for mesh in means[1:]:
        assert np.allclose(mesh.normals.mean(axis=0), means[0].normals.mean(axis=0), atol=0.06)
        assert mesh.openness.mean() == pytest.approx(means[0].openness.mean(), abs=0.05)
        assert mesh.wind.max(axis=0) == pytest.approx(means[0].wind.max(axis=0), abs=0.1)


def test_a_tree_without_leaves_keeps_its_wood(small):
    levels = levels_of(_bare(small), AssetSettings(texture_size=64))
    assert levels[1].silhouette_iou > 0.85
    assert levels[2].silhouette_iou > 0.6
    assert set(levels[2].model.parts) == {"trunk", "branches"}


def test_plain_colours_need_no_holes(small):
    levels = levels_of(small, AssetSettings(texture_size=0))
    assert levels[1].silhouette_iou > 0.88
    assert levels[1].model.parts["leaves"].material.base is None
    assert levels[3].model.parts["impostor"].material.base.shape == (256, 256, 4)


def test_a_crown_that_is_thinned_to_fewer_triangles_than_leaves_keeps_its_area(small):
    whole = model_of(small, AssetSettings(texture_size=64))
    (level,) = levels_of(small, AssetSettings(texture_size=64, lods=(1200,)))
    assert level.triangles <= 1200 < small.n_leaves
    assert level.silhouette_iou > 0.6
    tall = [model.parts["leaves"].mesh.vertices[:, 2].max() for model in (whole, level.model)]
    assert tall[1] == pytest.approx(tall[0], rel=0.05)


def test_the_same_plant_gives_the_same_bytes(small):
    settings = AssetSettings(texture_size=64, lods=(0.3, "billboard"))
    for one, other in zip(levels_of(small, settings), levels_of(small, settings), strict=True):
        for name, part in one.model.parts.items():
            again = other.model.parts[name]
            for field in ("vertices", "faces", "normals", "uv", "wind", "openness"):
                a, b = getattr(part.mesh, field), getattr(again.mesh, field)
                assert (a is None and b is None) or a.tobytes() == b.tobytes()
            if name == "impostor":
                assert part.material.base.tobytes() == again.material.base.tobytes()


@pytest.mark.parametrize("lods", [(0.4, 1.0), (5000, 20000), (0.4, 0.4)])
def test_levels_in_another_order_are_refused(lods):
    with pytest.raises(ValueError, match="each level needs less than the one before it"):
        AssetSettings(lods=lods)


@pytest.mark.parametrize("lods", [("billboard", 0.4), ("billboard", "billboard")])
def test_a_billboard_before_the_end_is_refused(lods):
    with pytest.raises(ValueError, match="billboard comes last and once"):
        AssetSettings(lods=lods)
