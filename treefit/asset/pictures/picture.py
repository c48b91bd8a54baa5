"""Picture: a plant in sun and shade as a person would look at it; drawn in software unless OpenGL is asked for.

`renderer=auto` is software: on a machine without a graphics card OpenGL takes eight times as long, and pyrender lets
no light through leaves and casts the shadows of whole cards. What is drawn is the exported model, textures and all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.model import Model, model_of
from treefit.asset.pictures.backdrop import backdrop, ground_rise
from treefit.asset.pictures.crease import creases
from treefit.asset.pictures.frame import Frame, frame_plant
from treefit.asset.pictures.light import sun_map
from treefit.asset.pictures.scene import Scene, scene_of
from treefit.asset.pictures.shade import shade
from treefit.asset.pictures.zbuffer import nearest_triangles
from treefit.asset.settings import AssetSettings
from treefit.plant import Plant

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB

_FINER = 2  # samples a pixel along each side
THINNEST = 0.3  # radius of a stem in pixels, that it be an unbroken line


def picture(
    plant: Plant,
    settings: AssetSettings,
    size: int | tuple[int, int] | Frame | None = None,
    seen: TreeColours | None = None,
) -> Picture:
    """Return a picture (h, w, 3) of `plant` from the front (orthographic, trunk base in the middle column).

    `size` is (h, w), or the height alone when the width shall follow the plant; default settings.picture_size.
    A Frame sets the scale too, so that several plants are shown at one. ValueError when settings.renderer is
    "pyrender" and there is no OpenGL.
    """
    model = model_of(plant, settings, seen)
    size = size or settings.picture_size
    frame = size if isinstance(size, Frame) else frame_of(model, size)
    if settings.renderer == "pyrender":
        from treefit.asset.pictures.gl_picture import gl_draw  # the view that it renders with imports meshes

        return gl_draw(model, frame, THINNEST / frame.scale)
    return draw(model, frame)


def check_renderer(settings: AssetSettings) -> None:
    """Raise ValueError with one line when settings.renderer cannot be had on this machine; for before a long search."""
    if settings.renderer == "pyrender":
        from treefit.asset.pictures.gl_picture import require_gl

        require_gl()


def frame_of(model: Model, size: int | tuple[int, int]) -> Frame:
    """Return the frame that shows a whole model."""
    return frame_plant(np.concatenate([part.mesh.vertices for part in model.parts.values()]), size)


def draw(model: Model, frame: Frame) -> Picture:
    """Return a picture (frame.height, frame.width, 3) of any model: a level of detail, crossed cards."""
    return draw_scene(scene_of(model, THINNEST / frame.scale), frame)


def draw_scene(scene: Scene, frame: Frame) -> Picture:
    """Return the picture of a scene, which may be turned."""
    finer = frame.finer(_FINER)
    screen = finer.project(scene.place)
    screen[:, 1] -= finer.scale * ground_rise(scene)
    seen, depth = nearest_triangles(screen, scene.faces, finer.height, finer.width, scene.holes)
    sun = sun_map(scene, frame.height)
    image = backdrop(frame, sun, scene)
    shade(scene, screen, seen, creases(depth, _FINER, scene.tall), sun, image)
    return _bytes(image)


_BAYER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]], dtype=np.float32) / 16


def _bytes(image: NDArray[np.float32]) -> Picture:
    """Round (h, w, 3) in [0, 1] to bytes up or down by a fixed pattern, so that the sky has no bands."""
    h, w = image.shape[:2]
    pattern = np.tile(_BAYER, (-(-h // 4), -(-w // 4)))[:h, :w, None]
    return np.asarray(np.minimum(image * 255 + pattern, 255), dtype=np.uint8)
