"""The files of a tree: levels, names, further formats."""

import dataclasses

import numpy as np
import pytest
import trimesh

from tests.asset.conftest import make_tree
from treefit.asset import AssetSettings, TreeColours, check_possible, write_tree
from treefit.asset.formats import usd
from treefit.plant import Plant

SMALL = AssetSettings(texture_size=0, lods=(1.0, 0.3), turntable=2)


@pytest.fixture(scope="module")
def plant() -> Plant:
    return make_tree(branches=10, twigs=4, leaves=300)


def test_each_level_has_a_file_and_one_file_has_all(plant, tmp_path):
    files = write_tree(tmp_path, plant, SMALL)
    assert [(level.name, level.file) for level in files.levels] == [
        ("tree_LOD0", "tree.glb"), ("tree_LOD1", "tree_LOD1.glb"),
    ]  # fmt: skip
    assert {path.name for path in tmp_path.iterdir()} == set(files.names) == {
        "tree.glb", "tree_LOD1.glb", "tree_lods.glb", "turntable.webp",
    }  # fmt: skip
    together = trimesh.load_scene(tmp_path / "tree_lods.glb", process=False)
    assert {name.rpartition("_")[2] for name in together.geometry} == {"LOD0", "LOD1"}


def test_counts_are_those_of_each_file(plant, tmp_path):
    files = write_tree(tmp_path, plant, SMALL)
    for level in files.levels:
        meshes = trimesh.load_scene(tmp_path / level.file, process=False).geometry.values()
        assert (level.triangles, level.vertices) == (
            sum(len(mesh.faces) for mesh in meshes), sum(len(mesh.vertices) for mesh in meshes),
        )  # fmt: skip
    whole, coarse = files.levels
    assert (files.counts.triangles, files.counts.vertices) == (whole.triangles, whole.vertices)
    assert coarse.triangles <= 0.3 * whole.triangles
    assert 0.5 < coarse.silhouette_iou < whole.silhouette_iou == 1


def test_one_level_needs_no_second_file_and_those_of_a_former_run_go(plant, tmp_path):
    for name in ("tree_LOD2.glb", "tree_lods.glb", "picture.png"):
        (tmp_path / name).write_bytes(b"old")
    assert write_tree(tmp_path, plant, AssetSettings(texture_size=0, lods=(1.0,), turntable=0)).names == ("tree.glb",)
    assert {path.name for path in tmp_path.iterdir()} == {"tree.glb", "picture.png"}


def test_further_formats_are_written_and_named(plant, tmp_path):
    pytest.importorskip("pxr", reason="usd-core is missing: pip install 'treefit[usd]'")
    settings = AssetSettings(texture_size=64, lods=(1.0,), formats=("obj", "ply", "usd", "json", "npz", "obj"))
    names = write_tree(tmp_path, plant, settings).names
    assert {path.name for path in tmp_path.iterdir()} == set(names)
    assert len(names) == len(set(names))
    assert {"tree.obj", "tree.mtl", "tree.usdz", "tree_skeleton.ply", "tree_skeleton.json", "tree_skeleton.npz"} < set(
        names
    )


def test_the_same_plant_gives_the_same_bytes(plant, tmp_path):
    settings = AssetSettings(texture_size=64, formats=("obj", "ply", "json", "npz"))
    for name in "ab":
        (tmp_path / name).mkdir()
        names = write_tree(tmp_path / name, plant, settings).names
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


def test_colours_of_the_picture_are_in_the_files(plant, tmp_path):
    settings = AssetSettings(texture_size=0, lods=(1.0,), formats=("obj",))
    write_tree(tmp_path, plant, settings, TreeColours(bark=(255, 0, 0), leaf=(0, 0, 255)))
    material = (tmp_path / "tree.mtl").read_text().splitlines()
    assert [line for line in material if line.startswith("Kd")] == [
        "Kd 1.0000 0.0000 0.0000",
        "Kd 0.0000 0.0000 1.0000",
    ]


def test_nan_is_refused_and_nothing_is_written(plant, tmp_path):
    broken = dataclasses.replace(plant, position=np.full_like(plant.position, np.nan))
    with pytest.raises(ValueError, match="plant: position has NaN"):
        write_tree(tmp_path, broken, SMALL)
    assert not [*tmp_path.iterdir()]


def test_a_missing_library_is_told_before_anything_is_done(plant, tmp_path, monkeypatch):
    monkeypatch.setattr(usd, "find_spec", lambda _: None)
    settings = AssetSettings(formats=("usd",))
    for act in (lambda: check_possible(settings), lambda: write_tree(tmp_path, plant, settings)):
        with pytest.raises(ValueError, match=r"pip install 'treefit\[usd\]'"):
            act()
    assert not [*tmp_path.iterdir()]
