"""Masks drawn by OpenGL through pyrender: slow, exact to the pixel, a check of the fast rasteriser."""

from __future__ import annotations

import os
from functools import cache
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh, branch_meshes, leaf_mesh
from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.plant.extent import extent_of

_SIDES = 16  # corners of the thickest stem: round enough to check by
_WOOD, _LEAVES = (255, 0, 0), (0, 255, 0)  # one channel a class, so that blended edges still say their shares


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


def gl_mask(plant: Plant, height_px: int, half_width: float) -> Mask:
    """Mask (height_px, round(2 * half_width * height_px)) of `plant` from the front.

    Shows z in [0, height] and x in [-half_width, half_width] plant heights, the trunk base in the middle.
    """
    missing = gl_missing()
    if missing is not None:
        raise ValueError(missing)
    import pyrender

    extent = extent_of(plant)
    scene = pyrender.Scene(bg_color=(0, 0, 0, 0))
    colours = {}
    for mesh in branch_meshes(plant, _SIDES, plain=True).values():
        colours[scene.add(_part(mesh))] = _WOOD
    if plant.n_leaves:
        colours[scene.add(_part(leaf_mesh(plant, "round")))] = _LEAVES
    near, far = _depths(scene)
    camera = pyrender.OrthographicCamera(
        xmag=half_width * extent.height,
        ymag=extent.height / 2,
        znear=0.05 * extent.height,
        zfar=far - near + extent.height,
    )
    scene.add(camera, pose=front_pose(near - 0.5 * extent.height, extent.height / 2))
    renderer = gl_renderer()
    renderer.viewport_width, renderer.viewport_height = round(2 * half_width * height_px), height_px
    colour, _ = renderer.render(scene, flags=int(pyrender.RenderFlags.SEG), seg_node_map=colours)
    return _classes(colour)


@cache
def gl_renderer() -> _Renderer:
    """Return the one renderer of this process; a context must be chosen before OpenGL is imported."""
    os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
    import pyrender

    return cast(_Renderer, pyrender.OffscreenRenderer(64, 64))


def _part(mesh: Mesh) -> Any:
    """Return `mesh` with every triangle from both sides: pyrender culls back faces in this mode."""
    import pyrender

    both = np.concatenate([mesh.faces, mesh.faces[:, ::-1]])
    return pyrender.Mesh([pyrender.Primitive(positions=mesh.vertices, indices=both, mode=4)])


def _depths(scene: Any) -> tuple[float, float]:
    low, high = scene.bounds[:, 1]
    return float(low), float(high)


def front_pose(y: float, z: float) -> NDArray[np.float64]:
    """Pose (4, 4) of a camera at (0, y, z) that looks along +y with z up."""
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = (1, 0, 0), (0, 0, 1), (0, -1, 0)
    pose[:3, 3] = (0, y, z)
    return pose


def _classes(colour: NDArray[np.uint8]) -> Mask:
    """Class of each pixel (h, w): the largest share where multisampling blended an edge."""
    wood, leaves = colour[..., 0].astype(int), colour[..., 1].astype(int)
    covered = wood + leaves >= 128
    return np.where(covered, np.where(wood > leaves, BRANCH, FOLIAGE), 0).astype(np.uint8)
