"""Turntable: a plant that turns once around its trunk, as an animated picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from treefit.asset.model import Model
from treefit.asset.pictures.frame import Frame, frame_plant
from treefit.asset.pictures.picture import THINNEST, Picture, draw_scene
from treefit.asset.pictures.scene import scene_of

_TURN = 3000  # milliseconds of a whole turn
_QUALITY, _EFFORT = 82, 4  # of WebP


def turntable(model: Model, count: int, height: int = 320) -> list[Picture]:
    """Return `count` pictures (height, w, 3) of `model` on its way around; it has room at every angle.

    The sun stays with the camera, as with a thing that is turned on a table: from behind half of all pictures would
    show the dark side. The shadow on the ground is that of the turned plant. Geometry and textures are prepared
    once; a coarser level of detail is quicker and looks the same at this size.
    """
    if count < 1:
        raise ValueError(f"turntable: count must be 1 or more, got {count}")
    frame = turning_frame(model, height)
    scene = scene_of(model, THINNEST / frame.scale)
    return [draw_scene(scene.turned(2 * np.pi * i / count), frame) for i in range(count)]


def turning_frame(model: Model, height: int) -> Frame:
    """Return the frame that shows a model at every angle."""
    place = np.concatenate([part.mesh.vertices for part in model.parts.values()])
    reach = np.hypot(place[:, 0], place[:, 1])
    return frame_plant(np.column_stack([reach, reach, place[:, 2]]), height)


def write_turntable(frames: Sequence[Picture], file: Path) -> None:
    """Write `frames` as an animated WebP that goes on for ever; ValueError when there is none."""
    if not frames:
        raise ValueError("turntable: needs one picture or more, got none")
    first, *others = [Image.fromarray(frame) for frame in frames]
    first.save(
        file, format="WEBP", save_all=True, append_images=others, duration=round(_TURN / len(frames)), loop=0,
        quality=_QUALITY, method=_EFFORT,
    )  # fmt: skip
