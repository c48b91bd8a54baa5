"""OBJ: a model as Wavefront OBJ with MTL and textures beside it, y up, metres."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from trimesh.exchange.obj import export_obj
from trimesh.visual import TextureVisuals
from trimesh.visual.material import SimpleMaterial

from treefit.asset.formats.image_file import ImageFile, image_file
from treefit.asset.formats.mesh_check import check_models
from treefit.asset.formats.tinted import tinted
from treefit.asset.formats.whole_file import write_whole
from treefit.asset.material.material import Material
from treefit.asset.model import Model


def write_obj(model: Model, path: Path | str) -> list[str]:
    """Write `model` to `path` (tree.obj), its materials beside it (tree.mtl, tree_bark.jpg ...); names of all files.

    Each part is an object of its name; paths are relative. The programs that read OBJ do not agree on how a
    colour and a texture are mixed, so textures have the colour in them; nor in what space a map of roughness or, as
    `map_Bump`, of normals is, so roughness is a number and normals are under `norm`.
    """
    check_models([model], "obj")
    path = Path(path)
    library = path.with_suffix(".mtl").name
    materials = {part.material.name: part.material for part in model.parts.values()}
    images = {name: _images(material, path.stem) for name, material in materials.items()}
    for files in images.values():
        for name, image in files.values():
            write_whole(path.with_name(name), image.data)
    described = [_described(material, images[name]) for name, material in materials.items()]
    write_whole(path.with_name(library), "\n".join(described).encode())
    text, _ = export_obj(_scene(model), include_normals=True, return_texture=True, digits=5, mtl_name=library,
                         header=f"{model.name}: y up, metres")  # fmt: skip
    write_whole(path, text.encode())
    return [path.name, library, *(name for files in images.values() for name, _ in files.values())]


def _images(material: Material, stem: str) -> dict[str, tuple[str, ImageFile]]:
    """Name and content of each texture, by the word that MTL has for it."""
    base = tinted(material)
    texels = {"map_Kd": ("", base), "norm": ("_normal", material.normal)}
    if material.cutoff is not None and base is not None and base.shape[2] == 4:
        texels["map_d"] = ("_alpha", np.repeat(base[..., 3:], 2, axis=2))  # some read its grey, some its alpha
    found = {}
    for word, (ending, texture) in texels.items():
        if texture is not None:
            image = image_file(texture)
            found[word] = (f"{stem}_{material.name}{ending}{image.suffix}", image)
    return found


def _described(material: Material, images: dict[str, tuple[str, ImageFile]]) -> str:
    red, green, blue = (1.0, 1.0, 1.0) if "map_Kd" in images else (value / 255 for value in material.colour)
    rough = material.rough * (1.0 if material.roughness is None else float(material.roughness.mean()) / 255)
    lines = [
        f"newmtl {material.name}", f"Kd {red:.4f} {green:.4f} {blue:.4f}", "Ks 0 0 0", "illum 1",
        f"Ns {1000 * (1 - rough) ** 2:.3f}", f"Pr {rough:.3f}", "Pm 0",
        *(f"{word} {name}" for word, (name, _) in images.items()),
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def _scene(model: Model) -> trimesh.Scene:
    """Parts as objects of their names, y up; the front (-y) becomes +z."""
    scene = trimesh.Scene()
    names = list(dict.fromkeys(part.material.name for part in model.parts.values()))
    for name, part in model.parts.items():
        mesh = part.mesh
        places, normals = (vectors[:, [0, 2, 1]] * (1, 1, -1) for vectors in (mesh.vertices, mesh.normals))
        told_apart = (names.index(part.material.name), 0, 0, 255)  # trimesh joins materials of one colour
        look = TextureVisuals(mesh.uv, material=SimpleMaterial(name=part.material.name, diffuse=told_apart))
        body = trimesh.Trimesh(places, mesh.faces, vertex_normals=normals, visual=look, process=False)
        scene.add_geometry(body, node_name=name, geom_name=name)
    return scene
