"""OBJ files as trimesh reads them."""

import numpy as np
import pytest
import trimesh
from PIL import Image

from tests.asset.formats.conftest import BARK, model, square
from treefit.asset.formats.obj import write_obj
from treefit.asset.material.colour import to_linear
from treefit.asset.model import Model


@pytest.fixture
def written(textured: Model, tmp_path):
    return tmp_path, write_obj(textured, tmp_path / "tree.obj")


def words(path, first: str) -> list[str]:
    return [line.removeprefix(first + " ") for line in path.read_text().splitlines() if line.startswith(first + " ")]


def test_parts_have_their_names_and_materials(written):
    folder, _ = written
    assert words(folder / "tree.obj", "o") == ["trunk", "branches", "leaves"]
    assert words(folder / "tree.obj", "usemtl") == ["bark", "bark", "leaves"]
    assert words(folder / "tree.mtl", "newmtl") == ["bark", "leaves"]


def test_all_files_are_named_and_paths_are_relative(written):
    folder, names = written
    assert {path.name for path in folder.iterdir()} == set(names)
    assert words(folder / "tree.obj", "mtllib") == ["tree.mtl"]
    told = [name for word in ("map_Kd", "map_d", "norm") for name in words(folder / "tree.mtl", word)]
    assert {*told, "tree.obj", "tree.mtl"} == set(names)


def test_the_mesh_is_that_of_the_model_with_y_up(written, textured):
    scene = trimesh.load_scene(written[0] / "tree.obj", process=False, split_objects=True, group_material=False)
    for name, part in textured.parts.items():
        mesh = scene.geometry[name]
        assert len(mesh.faces) == len(part.mesh.faces)
        x, y, z = part.mesh.vertices[part.mesh.faces].astype(float).transpose(2, 0, 1)
        np.testing.assert_allclose(mesh.triangles, np.stack([x, z, -y], axis=2), atol=2e-5)


def test_the_texture_has_the_colour_in_it(written):
    folder, _ = written
    assert words(folder / "tree.mtl", "Kd") == ["1.0000 1.0000 1.0000"] * 2
    texture = np.asarray(Image.open(folder / words(folder / "tree.mtl", "map_Kd")[0]))
    for shown, own in zip(texture.reshape(-1, 3)[::29], BARK.base.reshape(-1, 3)[::29], strict=True):
        np.testing.assert_allclose(to_linear(tuple(shown)), to_linear(tuple(own)) * to_linear(BARK.colour), atol=0.005)


def test_holes_are_there_for_programs_that_read_grey_and_for_those_that_read_alpha(written):
    folder, _ = written
    mask = Image.open(folder / words(folder / "tree.mtl", "map_d")[0])
    assert mask.mode == "LA"
    np.testing.assert_array_equal(*np.moveaxis(np.asarray(mask), 2, 0))


def test_without_textures_the_colour_is_in_the_material(tmp_path):
    assert write_obj(model(square()), tmp_path / "tree.obj") == ["tree.obj", "tree.mtl"]
    assert words(tmp_path / "tree.mtl", "Kd") == ["0.5020 0.5020 0.5020"]
