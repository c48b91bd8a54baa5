"""Materials of USD files: UsdPreviewSurface with textures."""

from __future__ import annotations

from typing import Any

from treefit.asset.formats.image_file import ImageFile, image_file
from treefit.asset.formats.tinted import tinted
from treefit.asset.material.colour import to_linear
from treefit.asset.material.material import Material, Texels


class UsdImages:
    """Pictures of a package by their names in it."""

    def __init__(self) -> None:
        self.files: dict[str, ImageFile] = {}

    def add(self, name: str, texels: Texels) -> str:
        """Keep `texels` and return the name of its file."""
        image = image_file(texels)
        path = f"textures/{name}{image.suffix}"
        self.files[path] = image
        return path


def usd_material(stage: Any, path: str, material: Material, images: UsdImages) -> None:
    """Define `material` at `path` of `stage`; its textures are added to `images`."""
    from pxr import Gf, Sdf, UsdShade

    made, kinds = UsdShade.Material.Define(stage, path), Sdf.ValueTypeNames
    surface = UsdShade.Shader.Define(stage, f"{path}/surface")
    surface.CreateIdAttr("UsdPreviewSurface")
    made.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
    surface.CreateInput("metallic", kinds.Float).Set(0.0)
    colour = surface.CreateInput("diffuseColor", kinds.Color3f)
    rough = surface.CreateInput("roughness", kinds.Float)
    base = tinted(material)
    if base is None:
        colour.Set(Gf.Vec3f(*to_linear(material.colour).tolist()))
    else:
        texture = _texture(stage, path, "base", images.add(f"{material.name}_base", base), "sRGB")
        colour.ConnectToSource(texture.CreateOutput("rgb", kinds.Float3))
        if material.cutoff is not None:
            opacity = surface.CreateInput("opacity", kinds.Float)
            opacity.ConnectToSource(texture.CreateOutput("a", kinds.Float))
            surface.CreateInput("opacityThreshold", kinds.Float).Set(material.cutoff)
    if material.roughness is None:
        rough.Set(material.rough)
    else:
        texture = _texture(
            stage, path, "roughness", images.add(f"{material.name}_roughness", material.roughness), "raw"
        )
        texture.CreateInput("scale", kinds.Float4).Set(Gf.Vec4f(*[material.rough] * 4))
        rough.ConnectToSource(texture.CreateOutput("r", kinds.Float))
    if material.normal is not None:
        texture = _texture(stage, path, "normal", images.add(f"{material.name}_normal", material.normal), "raw")
        texture.CreateInput("scale", kinds.Float4).Set(Gf.Vec4f(2, 2, 2, 1))
        texture.CreateInput("bias", kinds.Float4).Set(Gf.Vec4f(-1, -1, -1, 0))
        normal = surface.CreateInput("normal", kinds.Normal3f)
        normal.ConnectToSource(texture.CreateOutput("rgb", kinds.Float3))


def _texture(stage: Any, path: str, name: str, file: str, space: str) -> Any:
    """Return a texture that reads `file` where the mesh's `st` says."""
    from pxr import Sdf, UsdShade

    kinds = Sdf.ValueTypeNames
    place = UsdShade.Shader.Define(stage, f"{path}/place")
    place.CreateIdAttr("UsdPrimvarReader_float2")
    place.CreateInput("varname", kinds.String).Set("st")
    texture = UsdShade.Shader.Define(stage, f"{path}/{name}")
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", kinds.Asset).Set(file)
    texture.CreateInput("st", kinds.Float2).ConnectToSource(place.CreateOutput("result", kinds.Float2))
    texture.CreateInput("sourceColorSpace", kinds.Token).Set(space)
    for direction in ("wrapS", "wrapT"):
        texture.CreateInput(direction, kinds.Token).Set("repeat")
    return texture
