"""GLB: a plant as one glTF 2.0 binary file with named nodes and materials, y up, metres."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.visual.material import PBRMaterial

from treefit.asset.leaf_outline import outline_of
from treefit.asset.mesh import Mesh, branch_meshes, leaf_mesh
from treefit.asset.paint import to_linear
from treefit.asset.settings import AssetSettings
from treefit.plant import Plant, check_plant

_ATTRIBUTES, _INDICES = 34962, 34963  # OpenGL's names of buffer kinds


@dataclass(frozen=True)
class MeshCounts:
    """Counts over all meshes of a file."""

    vertices: int
    triangles: int


def write_glb(plant: Plant, path: Path | str, settings: AssetSettings) -> MeshCounts:
    """Write `plant` to `path` and return the counts that are in the file.

    Nodes and materials are 'trunk', 'branches' and 'leaves'; a part that the plant does not have is left out.
    """
    check_plant(plant)
    meshes = plant_meshes(plant, settings)
    if not meshes:
        raise ValueError("glb: the plant has no stem longer than zero and no leaf, nothing to write")
    scene = trimesh.Scene()
    for name, mesh in meshes.items():
        _check(name, mesh)
        scene.add_geometry(_geometry(name, mesh, settings), node_name=name, geom_name=name)
    data: bytes = scene.export(file_type="glb", include_normals=True, unitize_normals=False, tree_postprocessor=_finish)
    Path(path).write_bytes(data)
    return MeshCounts(
        vertices=sum(len(mesh.vertices) for mesh in meshes.values()),
        triangles=sum(len(mesh.faces) for mesh in meshes.values()),
    )


def plant_meshes(plant: Plant, settings: AssetSettings) -> dict[str, Mesh]:
    """Return the meshes by name ('trunk', 'branches', 'leaves') in the plant's frame, z up."""
    meshes = branch_meshes(plant, settings.sides)
    if plant.n_leaves:
        meshes["leaves"] = leaf_mesh(plant, outline_of(settings.leaf_outline, plant.look), settings.leaf_fold)
    return meshes


def _check(name: str, mesh: Mesh) -> None:
    if not all(np.isfinite(part).all() for part in (mesh.vertices, mesh.normals, mesh.uv)):
        raise ValueError(f"glb: mesh {name!r} has NaN or infinite values")
    if np.abs(np.linalg.norm(mesh.normals, axis=1) - 1).max() > 1e-3:
        raise ValueError(f"glb: mesh {name!r} has normals that are not of unit length (leaf axis or normal is zero?)")


def _geometry(name: str, mesh: Mesh, settings: AssetSettings) -> trimesh.Trimesh:
    material = PBRMaterial(
        name=name,
        baseColorFactor=[
            *to_linear(settings.leaf if name == "leaves" else settings.bark),
            1.0,
        ],  # the format wants linear
        metallicFactor=0.0,
        roughnessFactor=0.75 if name == "leaves" else 0.95,
        doubleSided=name == "leaves",
    )
    return trimesh.Trimesh(
        vertices=_y_up(mesh.vertices),
        faces=mesh.faces,
        vertex_normals=_y_up(mesh.normals),
        visual=trimesh.visual.TextureVisuals(uv=mesh.uv, material=material),
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
