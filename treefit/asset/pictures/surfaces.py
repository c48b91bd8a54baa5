"""Surfaces: the textures of materials as pyramids, made once for as long as the same textures are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.colour import to_linear
from treefit.asset.material.material import Material, Texels
from treefit.asset.pictures.pyramids import Pyramids, pack, pyramid

Floats = NDArray[np.float32]

_LINEAR = np.array([to_linear((byte, byte, byte))[0] for byte in range(256)], dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Surfaces:
    """What kernels read of a list of materials."""

    colour: Pyramids  # linear red, green, blue; alpha
    bump: Pyramids  # normal in tangent space (x, y, z); roughness
    tone: Floats  # (materials, 4): linear colour and roughness, which multiply the textures
    cutoff: Floats  # (materials,), -1 for one without holes
    thin: NDArray[np.bool_]  # (materials,) light comes through, and both sides are seen


def surfaces_of(materials: Sequence[Material]) -> Surfaces:
    """Return the surfaces of `materials`."""
    colour, bump = _pyramids(tuple(_Texture(m.base, m.normal, m.roughness, m.cutoff) for m in materials))
    tone = [(*to_linear(material.colour), material.rough) for material in materials]
    cutoff = [-1 if material.cutoff is None else material.cutoff for material in materials]
    thin = [material.two_sided for material in materials]
    return Surfaces(colour, bump, np.array(tone, np.float32), np.array(cutoff, np.float32), np.array(thin, np.bool_))


@dataclass(frozen=True, eq=False)
class _Texture:
    """Texels of a material; the same as another one when it is of the same arrays, whatever colour they are given."""

    base: Texels | None
    normal: Texels | None
    roughness: Texels | None
    cutoff: float | None

    def __hash__(self) -> int:
        return hash((id(self.base), id(self.normal), id(self.roughness), self.cutoff))

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, _Texture)
            and self.base is other.base
            and self.normal is other.normal
            and self.roughness is other.roughness
            and self.cutoff == other.cutoff
        )


@lru_cache(maxsize=2)  # 22 MB at 512 texels, three quarters of the time of a small picture
def _pyramids(textures: tuple[_Texture, ...]) -> tuple[Pyramids, Pyramids]:
    return pack([_colours(texture) for texture in textures]), pack([_bumps(texture) for texture in textures])


def _colours(texture: _Texture) -> list[Floats]:
    base = np.full((1, 1, 3), 255, dtype=np.uint8) if texture.base is None else texture.base
    image = np.ones((*base.shape[:2], 4), dtype=np.float32)
    image[..., :3] = _LINEAR[base[..., :3]]
    if base.shape[2] == 4:
        image[..., 3] = base[..., 3] / np.float32(255)
    return pyramid(image, texture.cutoff)


def _bumps(texture: _Texture) -> list[Floats]:
    """Normals and roughness, the coarser of the two repeated to the size of the finer one."""
    normal = np.zeros((1, 1, 3), dtype=np.uint8) if texture.normal is None else texture.normal
    rough = np.full((1, 1), 255, dtype=np.uint8) if texture.roughness is None else texture.roughness
    size = max(normal.shape[0], rough.shape[0]), max(normal.shape[1], rough.shape[1])
    image = np.empty((*size, 4), dtype=np.float32)
    image[..., :3] = (0, 0, 1) if texture.normal is None else _enlarged(normal, size) / np.float32(127.5) - 1
    image[..., 3] = _enlarged(rough, size) / np.float32(255)
    return pyramid(image)


def _enlarged(image: Texels, size: tuple[int, int]) -> Texels:
    rows = np.arange(size[0]) * image.shape[0] // size[0]
    columns = np.arange(size[1]) * image.shape[1] // size[1]
    return image if image.shape[:2] == size else image[np.ix_(rows, columns)]
