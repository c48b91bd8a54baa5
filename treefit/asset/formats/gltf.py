"""GltfFile: arrays and pictures put together as one binary glTF 2.0 file; knows nothing of trees.

trimesh writes such files too, but always re-encodes pictures, has 32 bits for every index and no second vertex colour.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from treefit.asset.formats.image_file import ImageFile

Json: TypeAlias = Mapping[str, object]

_ATTRIBUTES, _INDICES = 34962, 34963  # OpenGL's names of buffer kinds
_COMPONENTS = {"uint8": 5121, "uint16": 5123, "uint32": 5125, "float32": 5126}
_REPEAT, _LINEAR, _MIPMAPS = 10497, 9729, 9987
_RESTART = 0xFFFF  # no index of 16 bits may be this


class GltfFile:
    """Arrays, textures and materials by the index that nodes and meshes name them by; equal ones are kept once."""

    def __init__(self) -> None:
        self._data: list[bytes] = []
        self._length = 0
        self._views: list[Json] = []
        self._accessors: list[Json] = []
        self._images: dict[ImageFile, str] = {}
        self._materials: list[Json] = []
        self._meshes: list[Json] = []

    def attribute(self, values: NDArray[np.generic], bounds: bool = False) -> int:
        """Accessor of values (n, 2..4) a vertex: float32, or uint8 and uint16 that stand for [0, 1]."""
        whole = values.dtype != np.float32
        extent = {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()} if bounds else {}
        return self._accessor(values, f"VEC{values.shape[1]}", _ATTRIBUTES, {"normalized": True} if whole else extent)

    def indices(self, faces: NDArray[np.integer]) -> int:
        """Accessor of triangles (m, 3), in 16 bits where they do."""
        width = np.uint16 if faces.max() < _RESTART else np.uint32
        return self._accessor(faces.astype(width).ravel(), "SCALAR", _INDICES, {})

    def texture(self, image: ImageFile, name: str) -> int:
        """Texture of `image`, which repeats in both directions; equal images are one, under the first name."""
        self._images.setdefault(image, name)
        return [*self._images].index(image)

    def material(self, material: Json) -> int:
        """Material; the same one for equal materials."""
        if material not in self._materials:
            self._materials.append(material)
        return self._materials.index(material)

    def mesh(self, mesh: Json) -> int:
        """Mesh of one primitive or more."""
        self._meshes.append(mesh)
        return len(self._meshes) - 1

    def binary(self, nodes: Sequence[Json], roots: Sequence[int], asset: Json) -> bytes:
        """Bytes of the file with `nodes`, of which `roots` have no parent."""
        images = [
            {"name": name, "bufferView": self._view(image.data, {}), "mimeType": f"image/{image.kind}"}
            for image, name in self._images.items()
        ]
        textures = [{"sampler": 0, "source": index} for index in range(len(images))]
        sampler = {"magFilter": _LINEAR, "minFilter": _MIPMAPS, "wrapS": _REPEAT, "wrapT": _REPEAT}
        content = {
            "asset": {"version": "2.0", **asset}, "scene": 0, "scenes": [{"nodes": [*roots]}], "nodes": [*nodes],
            "meshes": self._meshes, "materials": self._materials, "textures": textures, "images": images,
            "samplers": [sampler] if images else [], "accessors": self._accessors, "bufferViews": self._views,
            "buffers": [{"byteLength": self._length}],
        }  # fmt: skip
        told = {name: part for name, part in content.items() if part != []}  # the format has no empty lists
        text = json.dumps(told, separators=(",", ":"), allow_nan=False).encode("utf-8")
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + 8 + self._length
        return b"".join([
            struct.pack("<4sII", b"glTF", 2, length), struct.pack("<I4s", len(text), b"JSON"), text,
            struct.pack("<I4s", self._length, b"BIN\0"), *self._data,
        ])  # fmt: skip

    def _accessor(self, values: NDArray[np.generic], kind: str, target: int, more: Json) -> int:
        little = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
        view = self._view(little.tobytes(), {"target": target})
        component = _COMPONENTS[values.dtype.name]
        self._accessors.append(
            {"bufferView": view, "componentType": component, "count": len(values), "type": kind, **more}
        )
        return len(self._accessors) - 1

    def _view(self, data: bytes, more: Json) -> int:
        """Buffer view of `data`; each begins at a multiple of 4 bytes."""
        self._views.append({"buffer": 0, "byteOffset": self._length, "byteLength": len(data), **more})
        padding = bytes(-len(data) % 4)
        self._data += [data, padding] if padding else [data]
        self._length += len(data) + len(padding)
        return len(self._views) - 1
