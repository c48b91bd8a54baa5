"""The same masks by other means: what the fast view is measured against, as far as this machine has them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from experiments.opencv_view import CORNERS, opencv_mask, opencv_missing
from experiments.zbuffer_view import ellipse, zbuffer_mask
from treefit.mask import Mask
from treefit.opengl import gl_missing
from treefit.plant import Plant
from treefit.view import Frame
from treefit.view.gl import gl_mask


@dataclass(frozen=True)
class Rival:
    """A way to draw masks; `missing` says why it cannot be had here; `threads`: it works on threads of its own."""

    title: str
    draw: Callable[[Plant, Frame], Mask]
    missing: str | None = None
    threads: bool = False


def rivals() -> Mapping[str, Rival]:
    """All rivals by a short name."""
    return {
        "zbuffer": Rival("naive z-buffer (numba)", _by_zbuffer),
        "opencv": Rival("OpenCV polygons", opencv_mask, "OpenCV is not installed" if opencv_missing() else None),
        "pyrender": Rival("pyrender (OpenGL)", _by_gl, gl_missing(), threads=True),
    }


def _by_zbuffer(plant: Plant, frame: Frame) -> Mask:
    return zbuffer_mask(plant, frame, ellipse(CORNERS))  # as many corners as OpenCV gets


def _by_gl(plant: Plant, frame: Frame) -> Mask:
    return gl_mask(plant, frame.height, frame.half_width)
