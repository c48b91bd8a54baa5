"""USD: the levels of a plant as one usdz package with its textures, y up, metres; needs the extra `usd`."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from treefit.asset.formats.image_file import ImageFile
from treefit.asset.formats.mesh_check import check_models
from treefit.asset.formats.usd_material import UsdImages, usd_material
from treefit.asset.formats.vertex_colours import vertex_colours
from treefit.asset.formats.whole_file import write_whole
from treefit.asset.model import Model, Part

ROOT = "/tree"
VARIANTS = "LOD"
"""The variant set whose choices are the levels."""

_ALIGNED = 64  # bytes; readers map files of a package into memory
_FIXED_HEADER = 30  # bytes of a local header in a zip file without name and extra field


def require_usd() -> None:
    """Raise ValueError when USD files cannot be written on this machine."""
    if find_spec("pxr") is None:
        raise ValueError("asset.formats: usd needs the package usd-core: pip install 'treefit[usd]'")


def write_usd(models: Sequence[Model], path: Path | str) -> None:
    """Write `models` to `path` (tree.usdz): a variant each of the set LOD, the first one chosen.

    Meshes have the names of their parts, materials are UsdPreviewSurface under /tree/materials.
    """
    require_usd()
    check_models(models, "usd")
    layer, images = _stage(models)
    write_whole(path, _package({"tree.usdc": layer, **{name: image.data for name, image in images.items()}}))


def _stage(models: Sequence[Model]) -> tuple[bytes, Mapping[str, ImageFile]]:
    """Bytes of the stage and the pictures that it names."""
    from pxr import Usd, UsdGeom

    stage, images = Usd.Stage.CreateInMemory(), UsdImages()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, ROOT).GetPrim()
    stage.SetDefaultPrim(root)
    materials = {part.material.name: part.material for model in models for part in model.parts.values()}
    UsdGeom.Scope.Define(stage, f"{ROOT}/materials")
    for name, material in materials.items():
        usd_material(stage, f"{ROOT}/materials/{name}", material, images)
    levels = root.GetVariantSets().AddVariantSet(VARIANTS)
    for model in models:
        level = model.name.rpartition("_")[2]
        levels.AddVariant(level)
        levels.SetVariantSelection(level)
        with levels.GetVariantEditContext():
            for name, part in model.parts.items():
                _mesh(stage, f"{ROOT}/{name}", part)
    levels.SetVariantSelection(models[0].name.rpartition("_")[2])
    with TemporaryDirectory() as folder:
        file = Path(folder) / "tree.usdc"
        stage.GetRootLayer().Export(str(file))
        return file.read_bytes(), images.files


def _mesh(stage: Any, path: str, part: Part) -> None:
    from pxr import Sdf, UsdGeom, UsdShade, Vt

    mesh, made = part.mesh, UsdGeom.Mesh.Define(stage, path)
    points = _y_up(mesh.vertices)
    made.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    made.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.stack([points.min(axis=0), points.max(axis=0)])))
    made.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(mesh.faces), 3, np.int32)))
    made.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.ascontiguousarray(mesh.faces, np.int32).ravel()))
    made.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_y_up(mesh.normals)))
    made.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    made.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    made.CreateDoubleSidedAttr(part.material.two_sided)
    shares = UsdGeom.PrimvarsAPI(made)
    uv = shares.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex)
    uv.Set(Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(mesh.uv, np.float32)))
    for name, colours in zip(("occlusion", "wind"), vertex_colours(mesh, "occlusion"), strict=False):
        share = shares.CreatePrimvar(name, Sdf.ValueTypeNames.Color4fArray, UsdGeom.Tokens.vertex)
        share.Set(Vt.Vec4fArray.FromNumpy(colours.astype(np.float32) / np.float32(255)))
    UsdShade.MaterialBindingAPI.Apply(made.GetPrim()).Bind(
        UsdShade.Material.Get(stage, f"{ROOT}/materials/{part.material.name}")
    )


def _y_up(vectors: Any) -> Any:
    return np.ascontiguousarray(np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]]), np.float32)


def _package(files: Mapping[str, bytes]) -> bytes:
    """A usdz package: a zip file, nothing compressed, each content at a multiple of 64 bytes.

    That of UsdUtils has the hour in it.
    """
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_STORED) as package:
        for name, data in files.items():
            begins = content.tell() + _FIXED_HEADER + len(name) + 4  # 4: head of the extra field
            fill = -begins % _ALIGNED
            entry = zipfile.ZipInfo(name)
            entry.extra = b"\x86\x19" + fill.to_bytes(2, "little") + bytes(fill)
            package.writestr(entry, data)
    return content.getvalue()
