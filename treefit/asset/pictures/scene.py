"""Scene: all parts of a model as one list of triangles with their textures, as the renderers of pictures take it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh
from treefit.asset.model import Model
from treefit.asset.pictures.surfaces import Surfaces, surfaces_of
from treefit.asset.pictures.thicken import pieces_of, thickened
from treefit.asset.pictures.zbuffer import Holes

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Scene:
    """Triangles of a plant in its own frame (z up, m), what is known at their corners, and their textures."""

    place: Floats  # (n, 3)
    normal: Floats  # (n, 3) unit
    uv: Floats  # (n, 2)
    sky: Floats  # (n,) share of the sky that is seen
    faces: NDArray[np.int32]  # (m, 3)
    texture: NDArray[np.int32]  # (m,) index into the surfaces
    piece: NDArray[np.int32]  # (m,) counts the pieces that hang together: a leaf, a stem
    surfaces: Surfaces

    @property
    def holes(self) -> Holes:
        """What the z-buffer asks for."""
        return Holes(self.uv, self.texture, self.surfaces.colour, self.surfaces.cutoff)

    @property
    def tall(self) -> float:
        """Height over the ground in m."""
        return max(float(self.place[:, 2].max()), 1e-6)

    def turned(self, angle: float) -> Scene:
        """Return the scene turned by `angle` radians around the trunk, counter-clockwise seen from above."""
        cos, sin = np.cos(angle), np.sin(angle)
        turn = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]], dtype=np.float32)
        place, normal = (np.einsum("ni,ji->nj", vectors, turn) for vectors in (self.place, self.normal))
        return replace(self, place=place, normal=normal)


def scene_of(model: Model, thinnest: float) -> Scene:
    """Return the scene of `model`; stems thinner than `thinnest` (radius in m) are drawn as thick as that."""
    parts = list(model.parts.values())
    materials = list(dict.fromkeys(part.material for part in parts))
    meshes = [part.mesh if part.material.two_sided else thickened(part.mesh, thinnest) for part in parts]
    starts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    faces = np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]).astype(np.int32)
    texture = np.repeat([materials.index(part.material) for part in parts], [len(mesh.faces) for mesh in meshes])
    return Scene(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.uv for mesh in meshes]),
        np.concatenate([_openness(mesh) for mesh in meshes]),
        faces,
        texture.astype(np.int32),
        pieces_of(faces),
        surfaces_of(materials),
    )


def _openness(mesh: Mesh) -> Floats:
    return np.ones(len(mesh.vertices), dtype=np.float32) if mesh.openness is None else mesh.openness
