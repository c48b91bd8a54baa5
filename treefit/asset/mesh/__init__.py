"""Meshes of plants: stems as tubes along curves, leaves as cards."""

from treefit.asset.mesh.leaves import leaf_mesh
from treefit.asset.mesh.mesh import Mesh
from treefit.asset.mesh.tubes import branch_meshes

__all__ = ["Mesh", "branch_meshes", "leaf_mesh"]
