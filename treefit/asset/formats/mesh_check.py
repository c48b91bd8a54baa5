"""The meshes of a model before they become a file: what no other program could use is refused."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh
from treefit.asset.model import Model


def check_models(models: Sequence[Model], kind: str) -> None:
    """Raise ValueError with the first thing that is wrong with a mesh of `models`; `kind` of file begins the line."""
    if not models:
        raise ValueError(f"{kind}: needs one model or more, got none")
    for model in models:
        if not model.parts:
            raise ValueError(f"{kind}: {model.name} has no mesh, nothing to write")
        for name, part in model.parts.items():
            fault = _fault(part.mesh)
            if fault is not None:
                raise ValueError(f"{kind}: mesh {name!r} of {model.name} {fault}")


def _fault(mesh: Mesh) -> str | None:
    n = len(mesh.vertices)
    if n == 0 or len(mesh.faces) == 0:
        return "has no triangle"
    shares = [part for part in (mesh.wind, mesh.openness) if part is not None]
    arrays = (mesh.vertices, mesh.normals, mesh.uv, *shares)
    if any(len(part) != n for part in arrays):
        return f"has {n} vertices and another count of normals, uv or colours"
    if not all(np.isfinite(part).all() for part in arrays):
        return "has NaN or infinite values"
    if mesh.faces.min() < 0 or mesh.faces.max() >= n:
        return f"has {n} vertices and triangles with others"
    if np.abs(np.einsum("ij,ij->i", mesh.normals, mesh.normals) - 1).max() > 2e-3:
        return "has normals that are not of unit length"
    if not _has_area(mesh):
        return "has only triangles without an area (leaf axis, normal or size is zero?)"
    return None


def _has_area(mesh: Mesh) -> bool:
    """Whether one triangle is more than a point or a line; the first ones tell it of every sound mesh."""
    return any(_areas(mesh, faces).any() for faces in (mesh.faces[:1000], mesh.faces[1000:]))


def _areas(mesh: Mesh, faces: NDArray[np.int32]) -> NDArray[np.float32]:
    a, b, c = (mesh.vertices[faces[:, corner]] for corner in range(3))
    return np.cross(b - a, c - a)
