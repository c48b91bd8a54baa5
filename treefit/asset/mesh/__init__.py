"""Meshes of plants: stems as tubes along curves, leaves as cards."""

from treefit.asset.mesh.leaves import leaf_mesh
from treefit.asset.mesh.mesh import Mesh
from treefit.asset.mesh.openness import crown_of
from treefit.asset.mesh.stems import stems_of
from treefit.asset.mesh.tubes import branch_meshes, tubes_of

__all__ = ["Mesh", "branch_meshes", "crown_of", "leaf_mesh", "stems_of", "tubes_of"]
