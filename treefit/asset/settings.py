"""AssetSettings: what a user may choose about the files and pictures of a plant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from PIL import ImageColor
from pydantic import BeforeValidator, ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.asset.leaf_outline import Outline

Colour = tuple[int, int, int]


def parse_colour(value: object) -> Colour:
    """Return (r, g, b) in 0..255 (sRGB) from '#rrggbb', a CSS colour name or three whole numbers."""
    if isinstance(value, str):
        try:
            red, green, blue = ImageColor.getrgb(value)[:3]
        except ValueError:
            raise ValueError(f"colour must be like '#6b4f3a' or a CSS colour name, got {value!r}") from None
        return int(red), int(green), int(blue)
    numbers = list(value) if isinstance(value, Sequence) else []
    if len(numbers) != 3 or not all(type(n) is int and 0 <= n <= 255 for n in numbers):
        raise ValueError(f"colour must be like '#6b4f3a' or [107, 79, 58] (numbers in 0..255), got {value!r}")
    return numbers[0], numbers[1], numbers[2]


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class AssetSettings:
    """Shape and colours of an exported plant and the size of its picture; colours are sRGB."""

    sides: Annotated[int, Field(ge=3, le=32)] = 7  # corners of the thickest stem
    leaf_outline: Outline = "auto"  # auto: the one that the generator gave the plant, else broad
    leaf_fold: Annotated[float, Field(ge=0, le=60)] = 18.0  # degrees each half is raised
    bark: Annotated[Colour, BeforeValidator(parse_colour)] = (112, 88, 68)
    leaf: Annotated[Colour, BeforeValidator(parse_colour)] = (98, 140, 62)
    picture_size: Annotated[int, Field(ge=16, le=4096)] = 512  # height in pixels
