"""USD packages as Pixar's library reads and validates them."""

import dataclasses
import zipfile

import numpy as np
import pytest

from tests.asset.formats.conftest import LEAVES
from treefit.asset.formats import usd
from treefit.asset.formats.usd import VARIANTS, write_usd
from treefit.asset.model import Model

pxr = pytest.importorskip("pxr", reason="usd-core is missing: pip install 'treefit[usd]'")


@pytest.fixture(scope="module")
def stage(textured: Model, tmp_path_factory):
    from pxr import Usd

    path = tmp_path_factory.mktemp("usd") / "tree.usdz"
    second = dataclasses.replace(textured, name="tree_LOD1", parts={"trunk": textured.parts["trunk"]})
    write_usd([textured, second], path)
    return Usd.Stage.Open(str(path))


def test_pixars_validators_find_nothing(stage):
    from pxr import UsdValidation

    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert [error.GetMessage() for error in UsdValidation.ValidationContext(validators).Validate(stage)] == []


def test_it_is_y_up_in_metres_and_its_root_is_the_tree(stage, textured):
    from pxr import UsdGeom

    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1
    assert stage.GetDefaultPrim().GetPath() == "/tree"
    points = np.array(UsdGeom.Mesh.Get(stage, "/tree/trunk").GetPointsAttr().Get())
    own = textured.parts["trunk"].mesh.vertices
    np.testing.assert_array_equal(points, np.column_stack([own[:, 0], own[:, 2], -own[:, 1]]))


def test_levels_are_variants_with_the_whole_model_chosen(stage):
    levels = stage.GetDefaultPrim().GetVariantSet(VARIANTS)
    assert levels.GetVariantNames() == ["LOD0", "LOD1"]
    assert levels.GetVariantSelection() == "LOD0"
    names = {child.GetName() for child in stage.GetDefaultPrim().GetChildren()}
    assert names == {"trunk", "branches", "leaves", "materials"}
    assert levels.SetVariantSelection("LOD1")
    assert {child.GetName() for child in stage.GetDefaultPrim().GetChildren()} == {"trunk", "materials"}
    levels.SetVariantSelection("LOD0")


def test_materials_have_their_textures_and_leaves_their_holes(stage):
    from pxr import UsdShade

    surface = UsdShade.Shader.Get(stage, "/tree/materials/leaves/surface")
    assert surface.GetInput("opacityThreshold").Get() == LEAVES.cutoff
    assert surface.GetInput("diffuseColor").HasConnectedSource()
    bound, _ = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath("/tree/leaves")).ComputeBoundMaterial()
    assert bound.GetPath() == "/tree/materials/leaves"
    with zipfile.ZipFile(stage.GetRootLayer().realPath) as package:
        assert package.testzip() is None
        assert package.namelist()[0] == "tree.usdc"
        assert all(info.compress_type == zipfile.ZIP_STORED for info in package.infolist())


def test_the_same_model_gives_the_same_bytes(textured, tmp_path):
    for name in ("a.usdz", "b.usdz"):
        write_usd([textured], tmp_path / name)
    assert (tmp_path / "a.usdz").read_bytes() == (tmp_path / "b.usdz").read_bytes()


def test_without_the_library_one_line_says_how_to_get_it(textured, tmp_path, monkeypatch):
    monkeypatch.setattr(usd, "find_spec", lambda _: None)
    with pytest.raises(ValueError, match=r"usd needs the package usd-core: pip install 'treefit\[usd\]'"):
        write_usd([textured], tmp_path / "t.usdz")
    assert not [*tmp_path.iterdir()]
