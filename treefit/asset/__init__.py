"""A plant becomes files."""

from treefit.asset.formats.glb import write_glb
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.model import MeshCounts
from treefit.asset.page.viewer import FactRow, FactTable, write_viewer
from treefit.asset.pictures.gallery import GalleryEntry, gallery
from treefit.asset.pictures.picture import picture
from treefit.asset.settings import AssetSettings

__all__ = [
    "AssetSettings", "FactRow", "FactTable", "GalleryEntry", "MeshCounts", "TreeColours",
    "gallery", "picture", "write_glb", "write_viewer",
]  # fmt: skip
