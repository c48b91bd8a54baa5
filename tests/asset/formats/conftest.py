"""Models for the tests of files: a square of two triangles, and a tree with textures and vertex colours."""

import dataclasses

import numpy as np
import pytest

from treefit.asset.material.material import Material
from treefit.asset.mesh import Mesh
from treefit.asset.model import Model, Part, model_of
from treefit.asset.settings import AssetSettings


def square(scale: float = 1.0) -> Mesh:
    """Return a square in the plane y = 0 that looks to the front (-y), its texture upright."""
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    vertices = np.column_stack([uv[:, 0], 0 * uv[:, 0], uv[:, 1]]).astype(np.float32)
    normals = np.tile(np.array([0, -1, 0], np.float32), (4, 1))
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    wind = np.array([[0, 0, 0], [0, 1, 0], [1, 1, 1], [1, 0, 1]], np.float32)
    return Mesh(vertices, faces, normals, uv * np.float32(scale), wind, np.array([0, 0.5, 1, 1], np.float32))


def model(*meshes: Mesh, material: Material | None = None, name: str = "tree_LOD0") -> Model:
    parts = zip(("trunk", "branches", "leaves"), meshes, strict=False)
    return Model(name, {part: Part(mesh, material or Material("bark", (128, 128, 128))) for part, mesh in parts})


def grain(*shape: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, shape, dtype=np.uint8)


def flat_normals(side: int) -> np.ndarray:
    return np.tile(np.array([128, 128, 255], np.uint8), (side, side, 1))


BARK = Material("bark", (150, 120, 90), grain(16, 16, 3), flat_normals(16), grain(16, 16, seed=1))
LEAVES = Material("leaves", (98, 140, 62), grain(8, 8, 4), flat_normals(8), None, 0.75, 0.5, True)


@pytest.fixture(scope="session")
def textured(tree) -> Model:
    """The tree with textures that are made up, and with wind and openness."""
    parts = {}
    for name, part in model_of(tree, AssetSettings(texture_size=0, sides=4)).parts.items():
        share = np.linspace(0, 1, len(part.mesh.vertices), dtype=np.float32)
        mesh = dataclasses.replace(part.mesh, wind=np.repeat(share[:, None], 3, axis=1), openness=share)
        parts[name] = Part(mesh, LEAVES if name == "leaves" else BARK)
    return Model("tree_LOD0", parts)
