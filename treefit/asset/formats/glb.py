"""GLB: models of a plant as one glTF 2.0 binary file with named nodes and materials, y up, metres."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.visual.material import PBRMaterial

from treefit.asset.material.colour import to_linear
from treefit.asset.material.material import Material
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.mesh import Mesh
from treefit.asset.model import MeshCounts, Model, model_of
from treefit.asset.settings import AssetSettings
from treefit.plant import Plant, check_plant

_ATTRIBUTES, _INDICES = 34962, 34963  # OpenGL's names of buffer kinds


def write_glb(plant: Plant, path: Path | str, settings: AssetSettings, seen: TreeColours | None = None) -> MeshCounts:
    """Write the whole model of `plant` to `path` and return the counts that are in the file.

    Nodes are 'trunk', 'branches' and 'leaves', materials 'bark' and 'leaves'; what the plant does not have is left out.
    """
    check_plant(plant)
    model = model_of(plant, settings, seen)
    write_models([model], path, settings)
    return model.counts


def write_models(models: Sequence[Model], path: Path | str, settings: AssetSettings) -> None:
    """Write `models` to `path`, each a node with its parts as children; parts have the plain names when it is one."""
    scene = trimesh.Scene()
    for model in models:
        scene.graph.update(model.name)
        for name, part in model.parts.items():
            _check(name, part.mesh)
            full = name if len(models) == 1 else f"{name}_{model.name.rpartition('_')[2]}"
            scene.add_geometry(_geometry(part.mesh, part.material), node_name=full, geom_name=full,
                               parent_node_name=model.name)  # fmt: skip
    data: bytes = scene.export(file_type="glb", include_normals=True, unitize_normals=False, tree_postprocessor=_finish)
    Path(path).write_bytes(data)


def _check(name: str, mesh: Mesh) -> None:
    if not all(np.isfinite(part).all() for part in (mesh.vertices, mesh.normals, mesh.uv)):
        raise ValueError(f"glb: mesh {name!r} has NaN or infinite values")
    if np.abs(np.linalg.norm(mesh.normals, axis=1) - 1).max() > 1e-3:
        raise ValueError(f"glb: mesh {name!r} has normals that are not of unit length (leaf axis or normal is zero?)")


def _geometry(mesh: Mesh, material: Material) -> trimesh.Trimesh:
    surface = PBRMaterial(
        name=material.name,
        baseColorFactor=[*to_linear(material.colour), 1.0],  # the format wants linear
        metallicFactor=0.0,
        roughnessFactor=material.rough,
        doubleSided=material.two_sided,
    )
    return trimesh.Trimesh(
        vertices=_y_up(mesh.vertices),
        faces=mesh.faces,
        vertex_normals=_y_up(mesh.normals),
        visual=trimesh.visual.TextureVisuals(uv=mesh.uv, material=surface),
        process=False,
    )


def _y_up(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """(n, 3) with z up turned to y up; the front (-y) becomes +z, as glTF wants it."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])


def _finish(tree: dict[str, Any]) -> None:
    """Say in the file's JSON who wrote it and what each buffer view is for (the GPU wants to know)."""
    tree["asset"]["generator"] = "treefit"
    accessors, views = tree["accessors"], tree["bufferViews"]
    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            views[accessors[primitive["indices"]]["bufferView"]]["target"] = _INDICES
            for accessor in primitive["attributes"].values():
                views[accessors[accessor]["bufferView"]]["target"] = _ATTRIBUTES
