"""A picture becomes a mask."""

from treefit.image.alpha import AlphaMask
from treefit.image.auto import AutoMask
from treefit.image.colour import ColourMask
from treefit.image.extraction import Extraction, Extractor
from treefit.image.file import FileMask
from treefit.image.help import Help
from treefit.image.helped import HelpedMask
from treefit.image.network import NetworkMask
from treefit.image.overlay import overlay
from treefit.image.picture import Picture
from treefit.image.read import PictureError, read_mask_file, read_picture, write_mask
from treefit.image.sketch import SketchMask

__all__ = [
    "AlphaMask",
    "AutoMask",
    "ColourMask",
    "Extraction",
    "Extractor",
    "FileMask",
    "Help",
    "HelpedMask",
    "NetworkMask",
    "Picture",
    "PictureError",
    "SketchMask",
    "overlay",
    "read_mask_file",
    "read_picture",
    "write_mask",
]
