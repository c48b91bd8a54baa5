"""Surroundings: boxes and pictures that stand around the tree, read from what the user says and checked."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

SHADE = 10.0
"""Shade that one height of a thing adds when nothing else is said, as much as the neighbours' foliage."""
LARGEST = 1024
"""Pixels of a side of a picture; larger ones are reduced."""
DEEP = 1.1
"""Heights to the front and to the back that a picture reaches when nothing else is said."""
_HALF_LIT = 128

Pixels = NDArray[np.uint8]  # (h, w), row 0 at the bottom, 0 free, 1 not
_BOX = ("from", "to", "solid", "shade")
_PICTURE = ("file", "left", "right", "bottom", "top", "front", "back", "solid", "shade")


@dataclass(frozen=True, eq=False)
class Thing:
    """A box with sides along the axes, or the pixels of a picture in it; lengths in heights of the tree."""

    corners: tuple[float, ...]  # x y z from, x y z to
    solid: bool  # nothing grows into it
    shade: float  # that one height of it adds
    pixels: Pixels | None = None  # None: the whole box

    def distance_to_foot(self) -> float:
        """Heights from the foot of the trunk, at the origin, to the nearest part."""
        low, high = np.array(self.corners[:3]), np.array(self.corners[3:])
        x, y, z = np.clip(0.0, low, high)
        if self.pixels is None:
            return math.sqrt(x * x + y * y + z * z)
        rows, columns = np.nonzero(self.pixels)
        size = (high - low)[[2, 0]] / self.pixels.shape
        x, z = low[0] + columns * size[1], low[2] + rows * size[0]
        x, z = np.clip(0.0, x, x + size[1]), np.clip(0.0, z, z + size[0])
        return math.sqrt(y * y + (x * x + z * z).min())


def read_box(given: object, place: str) -> Thing:
    """Box that {from, to, solid, shade} describes; `place` is its name in messages."""
    if not isinstance(given, Mapping) or not {"from", "to"} <= set(given):
        raise ValueError(f"{place}: must be {{from: [x, y, z], to: [x, y, z]}}, got {given!r}")
    _check_names(given, _BOX, place)
    low, high = numbers(given["from"], 3, f"{place}.from"), numbers(given["to"], 3, f"{place}.to")
    if not all(one < two for one, two in zip(low, high, strict=True)):
        raise ValueError(f"{place}: from must be under to in x, y and z, got {list(low)} and {list(high)}")
    return Thing((*low, *high), *_kind(given, place))


def read_picture(given: object, place: str) -> Thing:
    """Picture that {file, left, right, bottom, top, front, back, solid, shade} describes."""
    if not isinstance(given, Mapping) or not {"file", "left", "right", "top"} <= set(given):
        raise ValueError(f"{place}: must be {{file: , left: , right: , top: }}, got {given!r}")
    _check_names(given, _PICTURE, place)
    side = {"bottom": 0.0, "front": -DEEP, "back": DEEP}
    for name in ("left", "right", "bottom", "top", "front", "back"):
        (side[name],) = numbers([given.get(name, side.get(name))], 1, f"{place}.{name}")
    for low, high in (("left", "right"), ("bottom", "top"), ("front", "back")):
        if not side[low] < side[high]:
            raise ValueError(f"{place}: {low} must be under {high}, got {side[low]:g} and {side[high]:g}")
    corners = (side["left"], side["front"], side["bottom"], side["right"], side["back"], side["top"])
    return Thing(corners, *_kind(given, place), _read_pixels(given["file"], f"{place}.file"))


def numbers(given: object, count: int, place: str) -> tuple[float, ...]:
    """`count` finite numbers; ValueError when `given` is anything else."""
    right = isinstance(given, Sequence) and not isinstance(given, str) and len(given) == count
    values = list(given) if isinstance(given, Sequence) and right else []
    if not right or any(isinstance(x, bool) or not isinstance(x, int | float) or not math.isfinite(x) for x in values):
        wanted = "a number" if count == 1 else f"{count} numbers"
        shown = given[0] if count == 1 and isinstance(given, Sequence) else given
        raise ValueError(f"{place}: must be {wanted}, got {shown!r}")
    return tuple(float(value) for value in values)


def _kind(given: Mapping[str, object], place: str) -> tuple[bool, float]:
    solid = given.get("solid", True)
    if not isinstance(solid, bool):
        raise ValueError(f"{place}.solid: must be true or false, got {solid!r}")
    (shade,) = numbers([given.get("shade", SHADE)], 1, f"{place}.shade")
    if shade < 0:
        raise ValueError(f"{place}.shade: must be at least 0, got {shade:g}")
    return solid, shade


def _check_names(given: Mapping[str, object], names: tuple[str, ...], place: str) -> None:
    for name in given:
        if name not in names:
            raise ValueError(f"{place}.{name}: no such setting; there are {', '.join(names)}")


def _read_pixels(file: object, place: str) -> Pixels:
    """Pixels of a mask that are not 0, those of a picture with alpha that are not clear, of others the light ones."""
    if not isinstance(file, str | Path) or not Path(file).is_file():
        raise ValueError(f"{place}: no such file: {str(file)!r}")
    try:
        with Image.open(file) as image:
            found = _not_background(image)
    except Exception as error:  # Pillow's decoders raise nearly any exception on a damaged file
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise ValueError(f"{place}: cannot be read as a picture ({reason}); save it as PNG: {str(file)!r}") from error
    if not found.any():
        raise ValueError(f"{place}: has no pixel that is not background; make what stands there white: {str(file)!r}")
    step = -(-max(found.shape) // LARGEST)
    rows, columns = (-(-size // step) * step for size in found.shape)
    whole = np.zeros((rows, columns), np.uint8)
    whole[: found.shape[0], : found.shape[1]] = found
    return np.ascontiguousarray(whole.reshape(rows // step, step, columns // step, step).max(axis=(1, 3))[::-1])


def _not_background(image: Image.Image) -> NDArray[np.bool_]:
    if image.mode in ("P", "L", "1"):
        classes = np.asarray(image).astype(np.uint8)
        if image.mode == "1" or classes.max() <= 2:
            return classes > 0
    alpha = np.asarray(image.convert("RGBA"))[..., 3]
    if (alpha < _HALF_LIT).any():
        return alpha >= _HALF_LIT
    return np.asarray(image.convert("L")) >= _HALF_LIT
