"""A plant becomes files."""

from treefit.asset.files import LevelFile, TreeFiles, check_possible, write_tree
from treefit.asset.formats.glb import write_glb
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.model import MeshCounts
from treefit.asset.page.facts import FactRow, FactTable, ParameterRow
from treefit.asset.page.viewer import Level, ShownTree, write_viewer
from treefit.asset.pictures.gallery import GalleryEntry, gallery
from treefit.asset.pictures.picture import picture
from treefit.asset.settings import AssetSettings

__all__ = [
    "AssetSettings", "FactRow", "FactTable", "GalleryEntry", "Level", "LevelFile", "MeshCounts", "ParameterRow",
    "ShownTree", "TreeColours", "TreeFiles",
    "check_possible", "gallery", "picture", "write_glb", "write_tree", "write_viewer",
]  # fmt: skip
