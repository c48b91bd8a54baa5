"""GLB: models of a plant as one glTF 2.0 binary file with named nodes and materials, y up, metres."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from treefit.asset.formats.gltf import GltfFile, Json
from treefit.asset.formats.image_file import image_file
from treefit.asset.formats.mesh_check import check_models
from treefit.asset.formats.tangents import tangents
from treefit.asset.formats.vertex_colours import vertex_colours
from treefit.asset.formats.whole_file import write_whole
from treefit.asset.material.colour import to_linear
from treefit.asset.material.material import Material
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.model import MeshCounts, Model, Part, model_of
from treefit.asset.settings import AssetSettings
from treefit.plant import Plant, check_plant

CHANNELS = {"occlusion": "light (grey)", "wind": "bend, phase, flutter, openness"}
"""What is in the vertex colours, as the file itself says."""


def write_glb(plant: Plant, path: Path | str, settings: AssetSettings, seen: TreeColours | None = None) -> MeshCounts:
    """Write the whole model of `plant` to `path` and return the counts that are in the file.

    Nodes are 'trunk', 'branches' and 'leaves', materials 'bark' and 'leaves'; what the plant does not have is left out.
    """
    check_plant(plant)
    model = model_of(plant, settings, seen)
    write_models([model], path, settings)
    return model.counts


def write_models(models: Sequence[Model], path: Path | str, settings: AssetSettings) -> None:
    """Write `models` to `path`, each a node with its parts as children; pictures and materials are there once.

    Parts have their plain names when there is one model, else names like 'trunk_LOD1'. COLOR_0 and COLOR_1 are as
    `vertex_colours` says. ValueError, and no file, when a mesh is empty, not finite or without normals.
    """
    check_models(models, "glb")
    file = GltfFile()
    nodes: list[Json] = []
    roots = []
    for model in models:
        suffix = "" if len(models) == 1 else f"_{model.name.rpartition('_')[2]}"
        roots.append(len(nodes))
        counts = {"triangles": model.counts.triangles, "vertices": model.counts.vertices}
        nodes.append({"name": model.name, "children": [*range(len(nodes) + 1, len(nodes) + 1 + len(model.parts))],
                      "extras": counts})  # fmt: skip
        for name, part in model.parts.items():
            mesh = {"name": name + suffix, "primitives": [_primitive(file, part, settings)]}
            nodes.append({"name": name + suffix, "mesh": file.mesh(mesh)})
    write_whole(path, file.binary(nodes, roots, _asset(models, settings)))


def _asset(models: Sequence[Model], settings: AssetSettings) -> Json:
    """Who wrote the file, and what its vertex colours are."""
    meshes = [part.mesh for model in models for part in model.parts.values()]
    if all(mesh.wind is None and mesh.openness is None for mesh in meshes):
        return {"generator": "treefit"}
    first = settings.vertex_colours
    second = "wind" if first == "occlusion" else "occlusion"
    return {"generator": "treefit", "extras": {"COLOR_0": CHANNELS[first], "COLOR_1": CHANNELS[second]}}


def _primitive(file: GltfFile, part: Part, settings: AssetSettings) -> Json:
    mesh = part.mesh
    attributes = {
        "POSITION": file.attribute(_y_up(mesh.vertices), bounds=True),
        "NORMAL": file.attribute(_y_up(mesh.normals)),
        "TEXCOORD_0": file.attribute(_texture_place(mesh.uv)),
    }
    if part.material.normal is not None:
        tangent = tangents(mesh)
        attributes["TANGENT"] = file.attribute(np.column_stack([_y_up(tangent[:, :3]), tangent[:, 3]]))
    for index, colours in enumerate(vertex_colours(mesh, settings.vertex_colours)):
        attributes[f"COLOR_{index}"] = file.attribute(colours)
    return {"attributes": attributes, "indices": file.indices(mesh.faces), "material": _material(file, part.material)}


def _material(file: GltfFile, material: Material) -> int:
    surface: dict[str, object] = {
        "baseColorFactor": [*to_linear(material.colour).round(6).tolist(), 1.0],  # the format wants linear
        "metallicFactor": 0.0,
        "roughnessFactor": material.rough,
    }
    made: dict[str, object] = {"name": material.name, "pbrMetallicRoughness": surface}
    if material.base is not None:
        surface["baseColorTexture"] = {"index": file.texture(image_file(material.base), material.name)}
    if material.roughness is not None:  # green is roughness; blue, metal, is multiplied by 0
        grey = np.repeat(material.roughness[..., None], 3, axis=2)
        surface["metallicRoughnessTexture"] = {"index": file.texture(image_file(grey), f"{material.name}_roughness")}
    if material.normal is not None:
        made["normalTexture"] = {"index": file.texture(image_file(material.normal), f"{material.name}_normal")}
    if material.cutoff is not None:
        made |= {"alphaMode": "MASK", "alphaCutoff": material.cutoff}
    if material.two_sided:
        made["doubleSided"] = True
    return file.material(made)


def _y_up(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """(n, 3) with z up turned to y up; the front (-y) becomes +z, as glTF wants it."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]]).astype(np.float32)


def _texture_place(uv: NDArray[np.float32]) -> NDArray[np.float32] | NDArray[np.uint16]:
    """(n, 2) with v down, as glTF wants it; in 16 bits when all of it is in the unit square."""
    place = np.column_stack([uv[:, 0], 1 - uv[:, 1]]).astype(np.float32)
    if place.min() >= 0 and place.max() <= 1:
        return np.asarray(np.rint(place * 65535), dtype=np.uint16)
    return place
