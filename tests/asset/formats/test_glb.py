import dataclasses

import numpy as np
import pytest
import trimesh
from pydantic import ValidationError

from tests.asset.formats.glb_content import Glb
from treefit.asset import AssetSettings, write_glb
from treefit.plant import Plant

SMALL = AssetSettings(texture_size=64)


def header(path) -> dict:
    return Glb(path).json


def test_nodes_meshes_and_materials_keep_their_names(tree, tmp_path):
    write_glb(tree, tmp_path / "t.glb", SMALL)
    content = header(tmp_path / "t.glb")
    assert [part["name"] for part in content["meshes"]] == ["trunk", "branches", "leaves"]
    assert {part["name"] for part in content["nodes"]} >= {"tree_LOD0", "trunk", "branches", "leaves"}
    assert [part["name"] for part in content["materials"]] == ["bark", "leaves"]
    assert [bool(material.get("doubleSided")) for material in content["materials"]] == [False, True]


def test_counts_are_those_of_the_file(tree, tmp_path):
    counts = write_glb(tree, tmp_path / "t.glb", AssetSettings(sides=5, texture_size=0))
    scene = trimesh.load_scene(tmp_path / "t.glb", process=False)
    assert counts.vertices == sum(len(mesh.vertices) for mesh in scene.geometry.values())
    assert counts.triangles == sum(len(mesh.faces) for mesh in scene.geometry.values())


def test_the_tree_stands_in_metres_with_y_up_and_its_front_to_plus_z(tree, tmp_path):
    write_glb(tree, tmp_path / "t.glb", SMALL)
    trunk = trimesh.load_scene(tmp_path / "t.glb", process=False).geometry["trunk"]
    own = tree.position[tree.level == 0]
    assert trunk.bounds[1][1] == pytest.approx(own[:, 2].max(), abs=0.02)
    foot = trunk.vertices[trunk.vertices[:, 1] < 0.05].mean(axis=0)
    np.testing.assert_allclose(foot, 0, atol=0.05)
    front = tree.position[np.argmin(tree.position[:, 1])]
    wood = trimesh.load_scene(tmp_path / "t.glb", process=False).geometry["branches"]
    assert wood.bounds[1][2] == pytest.approx(-front[1], abs=0.05)


def test_colours_are_written_linear(tree, tmp_path):
    write_glb(tree, tmp_path / "t.glb", AssetSettings(leaf="#808080", texture_size=0))
    factor = header(tmp_path / "t.glb")["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"]
    np.testing.assert_allclose(factor, [0.216, 0.216, 0.216, 1], atol=0.003)


def test_the_same_plant_gives_the_same_bytes(tree, tmp_path):
    for name in "ab":
        write_glb(tree, tmp_path / name, SMALL)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_nan_and_empty_plants_are_refused_and_nothing_is_written(tree, tmp_path):
    broken = dataclasses.replace(tree, radius=np.full_like(tree.radius, np.nan))
    with pytest.raises(ValueError, match="radius has NaN"):
        write_glb(broken, tmp_path / "t.glb", SMALL)
    none, size = np.zeros((0, 3), np.float32), np.zeros((0, 2), np.float32)
    point = Plant(np.zeros((2, 3), np.float32), np.ones(2, np.float32), np.array([-1, 0], np.int32),
                  np.zeros(2, np.int32), none, none, none, size)  # fmt: skip
    with pytest.raises(ValueError, match="nothing to write"):
        write_glb(point, tmp_path / "t.glb", SMALL)
    assert not (tmp_path / "t.glb").exists()


def test_leaves_without_a_direction_are_refused(tree, tmp_path):
    flat = dataclasses.replace(tree, leaf_normal=np.zeros_like(tree.leaf_normal), leaf_axis=0 * tree.leaf_axis)
    with pytest.raises(ValueError, match="mesh 'leaves' of tree_LOD0 has only triangles without an area"):
        write_glb(flat, tmp_path / "t.glb", SMALL)


@pytest.mark.parametrize(
    "bad",
    [
        {"sides": 2},
        {"bark": "brownish"},
        {"leaf": [1, 2]},
        {"leaf_outline": "elm"},
        {"side": 7},
        {"texture_size": 500},
        {"texture_size": 32},
    ],
)
def test_bad_settings_are_refused(bad):
    with pytest.raises(ValidationError):
        AssetSettings(**bad)


def test_colours_may_be_hexadecimal_names_or_numbers():
    assert AssetSettings(bark="#ff0080").bark == AssetSettings(bark=[255, 0, 128]).bark == (255, 0, 128)
    assert AssetSettings(leaf="darkgreen").leaf == (0, 100, 0)
