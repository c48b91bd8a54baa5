"""What write_models puts into a file besides shapes: textures, vertex colours, levels, in as few bytes as it may."""

import dataclasses
import io

import numpy as np
import pytest
import trimesh
from PIL import Image

from tests.asset.formats.conftest import BARK, LEAVES, grain, model, square
from tests.asset.formats.glb_content import Glb
from treefit.asset.formats.glb import write_models
from treefit.asset.formats.vertex_colours import DARKEST
from treefit.asset.material.material import Material
from treefit.asset.mesh import Mesh
from treefit.asset.settings import AssetSettings


def written(tmp_path, *models, **settings) -> Glb:
    write_models(models, tmp_path / "t.glb", AssetSettings(**settings))
    return Glb(tmp_path / "t.glb")


def opened(picture: bytes) -> Image.Image:
    return Image.open(io.BytesIO(picture))


def test_textures_are_those_of_the_material(textured, tmp_path):
    glb = written(tmp_path, textured)
    bark, leaves = glb.materials["bark"], glb.materials["leaves"]
    base = opened(glb.picture(bark["pbrMetallicRoughness"]["baseColorTexture"]))
    np.testing.assert_array_equal(np.asarray(base), BARK.base)
    rough = opened(glb.picture(bark["pbrMetallicRoughness"]["metallicRoughnessTexture"]))
    np.testing.assert_array_equal(np.asarray(rough)[..., 1], BARK.roughness)
    np.testing.assert_array_equal(np.asarray(opened(glb.picture(bark["normalTexture"]))), BARK.normal)
    alpha = opened(glb.picture(leaves["pbrMetallicRoughness"]["baseColorTexture"]))
    assert (alpha.format, alpha.mode) == ("PNG", "RGBA")
    np.testing.assert_array_equal(np.asarray(alpha), LEAVES.base)
    assert (leaves["alphaMode"], leaves["alphaCutoff"], leaves["doubleSided"]) == ("MASK", 0.5, True)
    assert "alphaMode" not in bark
    assert [image["name"] for image in glb.json["images"]] == [
        "bark", "bark_roughness", "bark_normal", "leaves", "leaves_normal"
    ]  # fmt: skip


def test_a_smooth_opaque_texture_is_a_jpeg_near_the_original(tmp_path):
    base = np.asarray(Image.fromarray(grain(8, 8, 3)).resize((256, 256), Image.Resampling.BICUBIC))
    glb = written(tmp_path, model(square(), material=Material("bark", (255, 255, 255), base)))
    picture = opened(glb.picture(glb.materials["bark"]["pbrMetallicRoughness"]["baseColorTexture"]))
    assert picture.format == "JPEG"
    assert np.abs(np.asarray(picture).astype(int) - base).mean() < 1.5


def test_levels_share_materials_and_pictures(textured, tmp_path):
    second = dataclasses.replace(textured, name="tree_LOD1")
    one, two = written(tmp_path, textured), written(tmp_path, textured, second)
    assert two.json["materials"] == one.json["materials"]
    assert two.json["textures"] == one.json["textures"]
    assert [two.picture({"index": i}) for i in range(5)] == [one.picture({"index": i}) for i in range(5)]
    assert len(two.json["images"]) == 5
    assert len(two.json["meshes"]) == 2 * len(one.json["meshes"])


def test_each_level_is_a_node_with_its_parts_and_counts(textured, tmp_path):
    second = dataclasses.replace(textured, name="tree_LOD1", parts={"trunk": textured.parts["trunk"]})
    nodes = written(tmp_path, textured, second).json["nodes"]
    children = {
        node["name"]: [nodes[child]["name"] for child in node["children"]] for node in nodes if "children" in node
    }
    assert children == {"tree_LOD0": ["trunk_LOD0", "branches_LOD0", "leaves_LOD0"], "tree_LOD1": ["trunk_LOD1"]}
    scene = trimesh.load_scene(tmp_path / "t.glb", process=False)
    triangles = {name: len(mesh.faces) for name, mesh in scene.geometry.items()}
    for node in nodes:
        if "children" in node:
            assert node["extras"]["triangles"] == sum(triangles[name] for name in children[node["name"]])


def test_occlusion_is_grey_opaque_and_never_black(tmp_path):
    light = written(tmp_path, model(square())).array("trunk", "COLOR_0") / 255
    np.testing.assert_allclose(light[:, 0], DARKEST + (1 - DARKEST) * np.sqrt(square().openness), atol=1 / 255)
    assert (light[:, :1] == light[:, :3]).all()
    assert (light[:, 3] == 1).all()


@pytest.mark.parametrize(("first", "place"), [("occlusion", "COLOR_1"), ("wind", "COLOR_0")])
def test_wind_is_bend_phase_flutter_and_openness_in_the_set_that_is_asked_for(first, place, tmp_path):
    glb = written(tmp_path, model(square()), vertex_colours=first)
    told = np.column_stack([square().wind, square().openness])
    np.testing.assert_allclose(glb.array("trunk", place) / 255, told, atol=1 / 255)
    assert glb.json["asset"]["extras"][place].startswith("bend, phase, flutter")


def test_a_mesh_that_knows_no_wind_and_no_openness_has_no_colours(tmp_path):
    bare = dataclasses.replace(square(), wind=None, openness=None)
    glb = written(tmp_path, model(bare))
    assert set(glb.meshes["trunk"]["attributes"]) == {"POSITION", "NORMAL", "TEXCOORD_0"}
    assert glb.json["asset"] == {"version": "2.0", "generator": "treefit"}


def test_few_corners_take_short_indices_and_a_unit_square_short_uv(textured, tmp_path):
    glb = written(tmp_path, model(square(), square(scale=3)))
    assert (glb.array("trunk", "indices").dtype, glb.array("trunk", "TEXCOORD_0").dtype) == (np.uint16, np.uint16)
    assert glb.array("branches", "TEXCOORD_0").dtype == np.float32
    np.testing.assert_allclose(glb.array("branches", "TEXCOORD_0")[:, 1], 1 - square(3).uv[:, 1])


def test_indices_that_16_bits_cannot_hold_have_32(tmp_path):
    one, copies = square(), 1 << 14
    vertices, normals, uv = (np.tile(part, (copies, 1)) for part in (one.vertices, one.normals, one.uv))
    many = Mesh(vertices, one.faces + 4 * (copies - 1), normals, uv)
    indices = written(tmp_path, model(many)).array("trunk", "indices")
    assert (indices.max(), indices.dtype) == (4 * copies - 1, np.uint32)  # 65535 ends a strip in 16 bits


def test_what_cannot_be_used_is_refused_and_the_old_file_stays(tmp_path):
    whole = square()
    (tmp_path / "t.glb").write_bytes(b"old")
    bad = {
        "has no triangle": dataclasses.replace(whole, faces=whole.faces[:0]),
        "has NaN or infinite values": dataclasses.replace(whole, uv=whole.uv * np.float32("nan")),
        "has 4 vertices and triangles with others": dataclasses.replace(whole, faces=whole.faces + 1),
        "has 4 vertices and another count of": dataclasses.replace(whole, uv=whole.uv[:3]),
        "of unit length": dataclasses.replace(whole, normals=whole.normals * 0),
    }
    for reason, mesh in bad.items():
        with pytest.raises(ValueError, match=f"glb: mesh 'branches' of tree_LOD0 .*{reason}"):
            written(tmp_path, model(whole, mesh))
    with pytest.raises(ValueError, match="tree_LOD0 has no mesh, nothing to write"):
        written(tmp_path, model())
    assert (tmp_path / "t.glb").read_bytes() == b"old"
    assert [*tmp_path.iterdir()] == [tmp_path / "t.glb"]
