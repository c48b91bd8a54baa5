"""Model: meshes with their materials, one level of detail of a plant, as all files and pictures of it take it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from treefit.asset.material.material import Material
from treefit.asset.material.tree_materials import TreeColours, tree_materials
from treefit.asset.mesh import Mesh, crown_of, leaf_mesh, stems_of, tubes_of
from treefit.asset.mesh.leaf_outline import outline_of
from treefit.asset.settings import AssetSettings
from treefit.plant import Plant


@dataclass(frozen=True)
class MeshCounts:
    """Counts over all meshes of a file."""

    vertices: int
    triangles: int


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh in the plant's frame (z up, m) and what it is made of."""

    mesh: Mesh
    material: Material


@dataclass(frozen=True, eq=False)
class Model:
    """Parts by name: 'trunk', 'branches', 'leaves', those that the plant has; 'impostor' alone for crossed cards."""

    name: str  # tree_LOD0 and so on
    parts: Mapping[str, Part]

    @property
    def counts(self) -> MeshCounts:
        """Vertices and triangles of all parts."""
        meshes = [part.mesh for part in self.parts.values()]
        return MeshCounts(sum(len(mesh.vertices) for mesh in meshes), sum(len(mesh.faces) for mesh in meshes))


def model_of(plant: Plant, settings: AssetSettings, seen: TreeColours | None = None) -> Model:
    """Return the whole model of `plant`; ValueError when it has nothing to show. `seen`: colours of a picture."""
    outline = outline_of(settings.leaf_outline, plant)
    materials = tree_materials(settings, outline, seen)
    stems, crown = stems_of(plant), crown_of(plant)
    wood = tubes_of(stems, plant.look, settings.sides)
    parts = {name: Part(crown.shaded(mesh), materials["bark"]) for name, mesh in wood.items()}
    if plant.n_leaves:
        leaves = leaf_mesh(plant, outline, settings.leaf_fold, stems, crown)
        parts["leaves"] = Part(crown.shaded(leaves), materials["leaves"])
    if not parts:
        raise ValueError("model: the plant has no stem longer than zero and no leaf, nothing to write or show")
    return Model("tree_LOD0", parts)
