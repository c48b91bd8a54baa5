"""AssetSettings: what a user may choose about the files and pictures of a plant."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.asset.material.colour import Colour, parse_colour
from treefit.asset.mesh.leaf_outline import Outline

BarkKind = Literal["auto", "furrowed", "plated", "smooth", "ringed"]
Format = Literal["obj", "ply", "usd", "json", "npz"]
Detail = Annotated[float, Field(gt=0, le=1)] | Annotated[int, Field(ge=2)] | Literal["billboard"]
"""A share of the triangles of the whole model, a count of triangles, or crossed cards."""


SMALLEST_TEXTURE = 64
"""Pixels of the side of a texture that still shows what it is of."""


def _colour(value: object) -> Colour | None:
    return None if value is None else parse_colour(value)


def _descending(lods: tuple[Detail, ...]) -> tuple[Detail, ...]:
    """Return `lods`, finest first; whether a share is more than a count cannot be told without a plant."""
    if "billboard" in lods[:-1]:
        raise ValueError(f"billboard comes last and once, got {list(lods)}")
    for kind in (float, int):
        alike = [level for level in lods if isinstance(level, kind)]
        if any(coarse >= fine for fine, coarse in pairwise(alike)):
            raise ValueError(f"each level needs less than the one before it, got {list(lods)}")
    return lods


def _power_of_two(size: int) -> int:
    if size and (size < SMALLEST_TEXTURE or size & (size - 1)):
        raise ValueError(f"must be 0 or a power of two from {SMALLEST_TEXTURE} to 2048, got {size}")
    return size


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class AssetSettings:
    """Shape, materials, levels of detail and files of an exported plant, and its pictures; colours are sRGB."""

    sides: Annotated[int, Field(ge=3, le=32)] = 7  # corners of the thickest stem
    leaf_outline: Outline = "auto"  # auto: the one that the generator gave the plant, else by the leaf's size
    leaf_fold: Annotated[float, Field(ge=0, le=60)] = 18.0  # degrees each half is raised
    colours: Literal["from_image", "own"] = "from_image"  # where colours that are not given come from
    bark: Annotated[Colour | None, BeforeValidator(_colour)] = None
    leaf: Annotated[Colour | None, BeforeValidator(_colour)] = None
    bark_kind: BarkKind = "auto"
    texture_size: Annotated[int, Field(ge=0, le=2048), AfterValidator(_power_of_two)] = 512  # pixels, 0: plain colours
    vertex_colours: Literal["occlusion", "wind"] = "occlusion"  # what COLOR_0 holds; the other one is COLOR_1
    lods: Annotated[tuple[Detail, ...], AfterValidator(_descending)] = (1.0, 0.4, 0.15, "billboard")
    formats: tuple[Format, ...] = ()  # besides GLB
    picture_size: Annotated[int, Field(ge=16, le=4096)] = 512  # height in pixels
    renderer: Literal["auto", "software", "pyrender"] = "auto"
    turntable: Annotated[int, Field(ge=0, le=120)] = 24  # pictures of a whole turn, 0: none
