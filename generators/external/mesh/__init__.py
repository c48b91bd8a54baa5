"""Mesh: any mesh of a tree becomes a Plant, for generators that give no skeleton."""

from generators.external.mesh.glb import read_mesh
from generators.external.mesh.rules import Mesh
from generators.external.mesh.scene import plant_of_scene

__all__ = ["Mesh", "plant_of_scene", "read_mesh"]
