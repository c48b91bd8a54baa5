"""OpenGL without a display: whether it works here, the one renderer of a process, and a camera; knows no plants."""

from __future__ import annotations

import os
from functools import cache
from typing import Protocol, cast

import numpy as np
from numpy.typing import NDArray


class _Renderer(Protocol):
    viewport_width: int
    viewport_height: int

    def render(self, scene: object, flags: int, seg_node_map: object) -> tuple[NDArray[np.uint8], object]: ...


@cache
def gl_missing() -> str | None:
    """None when offscreen OpenGL works, else one line that says what is missing and how to get it."""
    try:
        gl_renderer()
    except Exception as error:  # PyOpenGL raises whatever it meets: AttributeError, OSError, TypeError, EGLError ...
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        return (
            f"offscreen OpenGL does not work ({reason}); on Debian or Ubuntu: "
            "apt-get install libegl1 libgl1 libxrender1; or use the view that needs none"
        )
    return None


@cache
def gl_renderer() -> _Renderer:
    """Return the one renderer of this process; a context must be chosen before OpenGL is imported."""
    os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
    import pyrender

    return cast(_Renderer, pyrender.OffscreenRenderer(64, 64))


def front_pose(y: float, z: float) -> NDArray[np.float64]:
    """Pose (4, 4) of a camera at (0, y, z) that looks along +y with z up."""
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = (1, 0, 0), (0, 0, 1), (0, -1, 0)
    pose[:3, 3] = (0, y, z)
    return pose
