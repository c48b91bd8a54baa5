"""Skeletons as JSON and npz give back the same plant; as PLY they are points and edges."""

import dataclasses
import json

import numpy as np
import pytest
import trimesh

from treefit.asset.formats.ply import write_ply
from treefit.asset.formats.skeleton import UNITS, read_skeleton, write_skeleton_json, write_skeleton_npz
from treefit.plant import Look, Plant

WRITERS = {".json": write_skeleton_json, ".npz": write_skeleton_npz}


def bare(tree: Plant) -> Plant:
    return dataclasses.replace(tree, **{name: getattr(tree, name)[:0] for name in UNITS if name.startswith("leaf_")})


@pytest.mark.parametrize("suffix", WRITERS)
@pytest.mark.parametrize("with_leaves", [True, False])
def test_a_skeleton_that_is_read_back_is_the_same_plant(tree, tmp_path, suffix, with_leaves):
    plant = dataclasses.replace(tree if with_leaves else bare(tree), cut=True, look=Look(3, 0.1, "lobed"))
    WRITERS[suffix](plant, tmp_path / f"tree{suffix}")
    back = read_skeleton(tmp_path / f"tree{suffix}")
    for name in UNITS:
        own, other = getattr(plant, name), getattr(back, name)
        assert (own.dtype, own.shape) == (other.dtype, other.shape)
        np.testing.assert_array_equal(own, other)
    assert (back.cut, back.look) == (plant.cut, plant.look)


@pytest.mark.parametrize("suffix", WRITERS)
def test_the_same_plant_gives_the_same_bytes(tree, tmp_path, suffix):
    for name in "ab":
        WRITERS[suffix](tree, tmp_path / f"{name}{suffix}")
    assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_the_files_say_their_units(tree, tmp_path):
    write_skeleton_json(tree, tmp_path / "tree.json")
    assert json.loads((tmp_path / "tree.json").read_text())["units"] == UNITS
    write_skeleton_npz(tree, tmp_path / "tree.npz")
    with np.load(tmp_path / "tree.npz", allow_pickle=False) as content:
        assert json.loads(str(content["units"])) == UNITS
        assert set(content) == {*UNITS, "units", "look", "cut"}


@pytest.mark.parametrize("name", ["tree.json", "tree.npz"])
@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 half", b'{"position": [[0, 0, 0]]}', b"[1, 2]"])
def test_a_file_that_is_no_skeleton_is_one_line(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ValueError, match=rf"skeleton .*{name}: not a skeleton file of treefit, or damaged") as error:
        read_skeleton(tmp_path / name)
    assert "\n" not in str(error.value)


def test_ply_holds_every_vertex_with_its_radius_and_every_segment(tree, tmp_path):
    write_ply(tree, tmp_path / "tree.ply")
    head, _, body = (tmp_path / "tree.ply").read_bytes().partition(b"end_header\n")
    assert b"format binary_little_endian 1.0" in head
    assert b"metres, z up" in head
    count = tree.n_vertices
    rows = np.frombuffer(body, "<f4", 6 * count).reshape(-1, 6)
    np.testing.assert_array_equal(rows[:, :3], tree.position)
    np.testing.assert_array_equal(rows[:, 3], tree.radius)
    whole = np.frombuffer(body, "<i4", 6 * count).reshape(-1, 6)
    np.testing.assert_array_equal(whole[:, 4:], np.column_stack([tree.level, tree.parent]))
    edges = np.frombuffer(body[24 * count :], "<i4").reshape(-1, 2)
    np.testing.assert_array_equal(edges, np.column_stack([tree.parent[1:], np.arange(1, count)]))
    np.testing.assert_allclose(trimesh.load(tmp_path / "tree.ply", process=False).vertices, tree.position, atol=1e-6)
