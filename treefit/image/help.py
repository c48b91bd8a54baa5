"""Help: what the user says of the tree in a picture, in its pixels or in shares of it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, ValidationInfo, field_validator
from pydantic.dataclasses import dataclass

from treefit.image.read import PictureError

Points = NDArray[np.float64]
"""(n, 2) x and y in pixels, from the left and from the top."""

Window = tuple[slice, slice]
"""Rows and columns of a part of a picture."""

Coordinate = Annotated[float, Field(ge=0, allow_inf_nan=False)]
RoughCoordinate = Annotated[float, Field(allow_inf_nan=False)]

FORMS = {"crop": "[left, top, right, bottom]", "point": "[x, y]", "outline": "[[x, y], [x, y], ...]"}
LEAST_SIDE = 16
ROUGH = 0.03
"""Share of its size by which an outline may be off."""
LEAST_AREA = 1e-4


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Help:
    """Whatever the user gives; numbers are pixels of the upright picture, or shares of it when none is over 1.

    `crop` is left, top, right, bottom of the part to look at; `point` is x, y on the tree; `outline` are at least 3
    points around it, drawn by a rough hand; `hint` is a copy of the picture with strokes of paint on it.
    """

    crop: tuple[Coordinate, Coordinate, Coordinate, Coordinate] | None = None
    point: tuple[Coordinate, Coordinate] | None = None
    outline: tuple[tuple[RoughCoordinate, RoughCoordinate], ...] | None = None
    hint: Path | None = None

    @field_validator("crop", "point", "outline", mode="before")
    @classmethod
    def _is_numbers(cls, given: object, info: ValidationInfo) -> object:
        form = FORMS[str(info.field_name)]
        rows = given if info.field_name == "outline" else [given]
        length = 4 if info.field_name == "crop" else 2
        if given is not None and not (
            isinstance(rows, list | tuple) and all(_are_numbers(row, length) for row in rows)
        ):
            raise ValueError(f"must be {form}, all of them numbers; got {given}")
        return given

    @field_validator("crop")
    @classmethod
    def _has_an_inside(cls, crop: tuple[float, ...] | None) -> tuple[float, ...] | None:
        if crop is not None and (crop[0] >= crop[2] or crop[1] >= crop[3]):
            raise ValueError(
                f"must be [left, top, right, bottom], left under right, top under bottom; got {_show(crop)}"
            )
        return crop

    @field_validator("outline")
    @classmethod
    def _is_a_polygon(cls, outline: tuple[tuple[float, float], ...] | None) -> tuple[tuple[float, float], ...] | None:
        if outline is not None and len(set(outline)) < 3:
            raise ValueError(f"must have at least 3 different points [x, y], got {len(set(outline))}")
        return outline

    def __bool__(self) -> bool:
        return any(part is not None for part in (self.crop, self.point, self.outline, self.hint))

    def window(self, shape: tuple[int, int]) -> Window:
        """Part of a picture of `shape` (h, w) to be looked at; PictureError when it is outside or too small."""
        height, width = shape
        if self.crop is None:
            return slice(0, height), slice(0, width)
        (left, top), (right, bottom) = np.round(_pixels(np.reshape(self.crop, (2, 2)), shape)).astype(int).tolist()
        if right > width or bottom > height:
            raise PictureError(f"mask.crop: {_show(self.crop)} reaches out of the picture of {_size(shape)}")
        if min(right - left, bottom - top) < LEAST_SIDE:
            raise PictureError(
                f"mask.crop: {_show(self.crop)} leaves {right - left} x {bottom - top} pixels of the picture of "
                f"{_size(shape)}, at least {LEAST_SIDE} x {LEAST_SIDE} are needed"
            )
        return slice(top, bottom), slice(left, right)

    def pixel(self, shape: tuple[int, int]) -> tuple[int, int] | None:
        """Row and column of `point`, None without one; PictureError when it is not on what is looked at."""
        if self.point is None:
            return None
        x, y = _pixels(np.array([self.point]), shape)[0]
        _check_inside("mask.point", (x, y), self.point, shape, tolerance=0)
        row, column = min(int(y), shape[0] - 1), min(int(x), shape[1] - 1)
        rows, columns = self.window(shape)
        if not (rows.start <= row < rows.stop and columns.start <= column < columns.stop):
            raise PictureError(f"mask.point: {_show(self.point)} is outside mask.crop {_show(self.crop or ())}")
        return row, column

    def polygon(self, shape: tuple[int, int]) -> Points | None:
        """Corners of `outline`, None without one; PictureError when it leaves the picture or has no inside."""
        if self.outline is None:
            return None
        corners = _pixels(np.array(self.outline), shape)
        for corner, given in zip(corners, self.outline, strict=True):
            _check_inside("mask.outline", corner, given, shape, tolerance=ROUGH * max(shape))
        corners = np.clip(corners, 0, (shape[1], shape[0]))
        x, y = corners.T
        area = abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))) / 2
        if area < LEAST_AREA * shape[0] * shape[1]:
            raise PictureError(f"mask.outline: encloses next to nothing of the picture of {_size(shape)}")
        return corners


def _are_numbers(row: object, length: int) -> bool:
    numbers = isinstance(row, list | tuple) and all(isinstance(x, int | float) and not isinstance(x, bool) for x in row)
    return numbers and len(row) == length  # type: ignore[arg-type]


def _pixels(points: Points, shape: tuple[int, int]) -> Points:
    """`points` in pixels, given so or in shares of a picture of `shape` (h, w)."""
    return points * (shape[1], shape[0]) if (points <= 1).all() else points


def _check_inside(
    name: str, point: tuple[float, float] | Points, given: tuple[float, ...], shape: tuple[int, int], tolerance: float
) -> None:
    outside = [not -tolerance <= at <= side + tolerance for at, side in zip(point, shape[::-1], strict=True)]
    if any(outside):
        raise PictureError(f"{name}: {_show(given)} is outside the picture of {_size(shape)}")


def _size(shape: tuple[int, int]) -> str:
    return f"{shape[1]} x {shape[0]} pixels"


def _show(numbers: tuple[float, ...]) -> str:
    return f"[{', '.join(f'{number:g}' for number in numbers)}]"
