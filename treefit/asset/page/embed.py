"""Embedding: pictures, masks, files and facts as text that can stand inside an HTML page."""

from __future__ import annotations

import base64
import hashlib
import io
import json
import zlib

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from treefit.mask import Mask

CLASS_STEP = 100  # grey of a mask's pixel by its class: 0, 100, 200


def picture_address(pixels: NDArray[np.uint8], longest: int) -> str:
    """Return a picture (h, w, 3) or (h, w, 4) as the address of a JPEG, its longer side at most `longest` pixels."""
    image = Image.fromarray(pixels).convert("RGB")
    image.thumbnail((longest, longest), Image.Resampling.LANCZOS)
    content = io.BytesIO()
    image.save(content, "JPEG", quality=86, optimize=True)
    return f"data:image/jpeg;base64,{_base64(content.getvalue())}"


def mask_address(mask: Mask, longest: int) -> str:
    """Return a mask (h, w) as the address of a grey PNG, CLASS_STEP a class, at most `longest` pixels long."""
    image = Image.fromarray(mask * np.uint8(CLASS_STEP))
    image.thumbnail((longest, longest), Image.Resampling.NEAREST)
    content = io.BytesIO()
    image.save(content, "PNG", optimize=True)
    return f"data:image/png;base64,{_base64(content.getvalue())}"


def packed(content: bytes) -> str:
    """Return `content` deflated (zlib, as browsers' DecompressionStream reads it) in base 64."""
    return _base64(zlib.compress(content, 6))


def json_for_script(content: object) -> str:
    """JSON that can stand inside <script>: no character in it can end the element or begin a comment."""
    text = json.dumps(content, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def integrity(text: str) -> str:
    """Return the source expression by which a Content-Security-Policy allows the inline `text` and no other."""
    return f"'sha256-{_base64(hashlib.sha256(text.encode('utf-8')).digest())}'"


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")
