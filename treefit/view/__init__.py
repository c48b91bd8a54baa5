"""A plant becomes a mask."""

from treefit.view.frame import BitMask, Frame, frame_for, sample
from treefit.view.orthographic import OrthographicView

__all__ = ["BitMask", "Frame", "OrthographicView", "frame_for", "sample"]
