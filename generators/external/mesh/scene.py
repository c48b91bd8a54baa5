"""Scene: the parts of a mesh of a tree, told apart as wood and leaves, become a Plant."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from generators.external.mesh.joining import joints_of
from generators.external.mesh.leaves import Leaves, leaves_of
from generators.external.mesh.parts import Parts, parts_of
from generators.external.mesh.rings import rings_of
from generators.external.mesh.rules import Mesh
from generators.external.mesh.sources import sources_of
from generators.external.mesh.stems import Stems, stems_of
from generators.external.mesh.tell import tell_apart
from treefit.plant import Plant, check_plant

if TYPE_CHECKING:
    import trimesh


def plant_of_scene(scene: trimesh.Scene | trimesh.Trimesh, rules: Mesh, up: str) -> Plant:
    """Plant of a scene or a mesh of trimesh with the axis `up` ("z" or "y") pointing upwards.

    Wood becomes a curve skeleton, all of it joined to the trunk, whose base moves to the origin; each flat piece of
    foliage becomes a leaf. ValueError in one line when there is no tree in it.
    """
    return plant_of_parts(parts_of(scene, up), rules)


def plant_of_parts(parts: Parts, rules: Mesh) -> Plant:
    """Plant of parts with their names, z upwards."""
    wood, foliage, count = tell_apart(parts, rules)
    source, piece, trunk = sources_of(wood.places, wood.triangles)
    rings = rings_of(wood.places, wood.triangles, source, piece, trunk)
    stems = stems_of(rings, joints_of(rings))
    if len(stems.radius) < 2:
        raise ValueError("mesh: its wood has no length, a stem needs two rings or more")
    leaves = leaves_of(foliage.places, foliage.triangles, rings)
    plant = _plant(stems, leaves, count / (rules.vertices_per_node or 1.0))
    check_plant(plant)
    if not plant.position[:, 2].max() > 0:
        raise ValueError("mesh: has no height over the base of its trunk; is another axis up?")
    return plant


def _plant(stems: Stems, leaves: Leaves, complexity: float) -> Plant:
    root = stems.position[0].copy()
    return Plant(
        _rows(stems.position - root), stems.radius.astype(np.float32), stems.parent, stems.level,
        _rows(leaves.position - root), _rows(leaves.axis), _rows(leaves.normal), _rows(leaves.size),
        complexity=complexity,
    )  # fmt: skip


def _rows(values: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return `values` (n, d) as a view of contiguous rows."""
    return np.ascontiguousarray(values.T, dtype=np.float32).T
