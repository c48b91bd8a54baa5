"""ImageFile: a texture as the PNG or JPEG that files carry; every texture is encoded once."""

from __future__ import annotations

import io
import zlib
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from PIL import Image

from treefit.asset.material.material import Texels

_QUALITY = 92  # of JPEG without chroma subsampling: 0.5 to 1 % from the original, unseen on bark
_WORTH = 0.7  # a JPEG is taken when it has at most so much of the bytes without loss
_KEPT = 12  # textures of a tree and of an impostor, twice


@dataclass(frozen=True)
class ImageFile:
    """Bytes of a picture file; equal textures have equal bytes."""

    data: bytes
    kind: Literal["png", "jpeg"]

    @property
    def suffix(self) -> str:
        """End of the file's name."""
        return ".png" if self.kind == "png" else ".jpg"


def image_file(texels: Texels) -> ImageFile:
    """Return `texels` (h, w) or (h, w, 2..4) as PNG, or as JPEG when they have no alpha and it is smaller."""
    return _encoded(np.ascontiguousarray(texels, dtype=np.uint8).tobytes(), texels.shape)


@lru_cache(maxsize=_KEPT)
def _encoded(texels: bytes, shape: tuple[int, ...]) -> ImageFile:
    image = Image.fromarray(np.frombuffer(texels, np.uint8).reshape(shape))
    if image.mode in ("L", "RGB"):
        near = _saved(image, "JPEG", quality=_QUALITY, subsampling=0)  # Pillow's buffer is too small to optimise
        if len(near) <= _WORTH * len(zlib.compress(texels, 1)):
            return ImageFile(near, "jpeg")
    return ImageFile(_saved(image, "PNG"), "png")


def _saved(image: Image.Image, kind: str, **options: int) -> bytes:
    content = io.BytesIO()
    image.save(content, kind, **options)
    return content.getvalue()
