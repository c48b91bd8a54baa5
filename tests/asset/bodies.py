"""Plants of a few vertices, and what the tests ask of meshes."""

import numpy as np
import trimesh

from treefit.asset.mesh import Mesh
from treefit.plant import Plant


def wood(position, radius, parent, level):
    none = np.zeros((0, 3), np.float32)
    return Plant(
        np.array(position, np.float32), np.array(radius, np.float32), np.array(parent, np.int32),
        np.array(level, np.int32), none, none, none, np.zeros((0, 2), np.float32),
    )  # fmt: skip


def solid(mesh: Mesh) -> trimesh.Trimesh:
    """Return the mesh with its seams sewn up."""
    body = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    body.merge_vertices(merge_tex=True, merge_norm=True)
    return body


def areas(mesh: Mesh) -> np.ndarray:
    a, b, c = mesh.vertices[mesh.faces].astype(float).transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
