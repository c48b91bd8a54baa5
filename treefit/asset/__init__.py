"""A plant becomes files."""

from treefit.asset.gallery import GalleryEntry, gallery
from treefit.asset.glb import MeshCounts, write_glb
from treefit.asset.picture import picture
from treefit.asset.settings import AssetSettings
from treefit.asset.viewer import FactRow, FactTable, write_viewer

__all__ = [
    "AssetSettings", "FactRow", "FactTable", "GalleryEntry", "MeshCounts",
    "gallery", "picture", "write_glb", "write_viewer",
]  # fmt: skip
