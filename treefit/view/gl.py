"""Masks drawn by OpenGL through pyrender: slow, exact to the pixel, a check of the fast rasteriser."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from treefit.asset.mesh import Mesh, branch_meshes, leaf_mesh
from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.opengl import front_pose, gl_missing, gl_renderer
from treefit.plant import Plant
from treefit.plant.extent import extent_of

_SIDES = 16  # corners of the thickest stem: round enough to check by
_WOOD, _LEAVES = (255, 0, 0), (0, 255, 0)  # one channel a class, so that blended edges still say their shares


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


def _part(mesh: Mesh) -> Any:
    """Return `mesh` with every triangle from both sides: pyrender culls back faces in this mode."""
    import pyrender

    both = np.concatenate([mesh.faces, mesh.faces[:, ::-1]])
    return pyrender.Mesh([pyrender.Primitive(positions=mesh.vertices, indices=both, mode=4)])


def _depths(scene: Any) -> tuple[float, float]:
    low, high = scene.bounds[:, 1]
    return float(low), float(high)


def _classes(colour: NDArray[np.uint8]) -> Mask:
    """Class of each pixel (h, w): the largest share where multisampling blended an edge."""
    wood, leaves = colour[..., 0].astype(int), colour[..., 1].astype(int)
    covered = wood + leaves >= 128
    return np.where(covered, np.where(wood > leaves, BRANCH, FOLIAGE), 0).astype(np.uint8)
