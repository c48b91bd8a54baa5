"""A reader of binary glTF for the tests, as short as the format is."""

import json
import struct
from pathlib import Path

import numpy as np

_KINDS = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Glb:
    """Content of a file: `json`, arrays by mesh and attribute, pictures as bytes."""

    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        length = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]
        self.meshes = {mesh["name"]: mesh["primitives"][0] for mesh in self.json["meshes"]}
        self.materials = {material["name"]: material for material in self.json["materials"]}

    def array(self, mesh: str, attribute: str) -> np.ndarray:
        """Return the values as they are written."""
        primitive = self.meshes[mesh]
        accessor = self.json["accessors"][primitive["attributes"].get(attribute, primitive["indices"])]
        values = np.frombuffer(self._view(accessor["bufferView"]), _KINDS[accessor["componentType"]])
        return values.reshape(accessor["count"], _WIDTHS[accessor["type"]])

    def picture(self, texture: dict) -> bytes:
        image = self.json["images"][self.json["textures"][texture["index"]]["source"]]
        return self._view(image["bufferView"])

    def _view(self, index: int) -> bytes:
        view = self.json["bufferViews"][index]
        return self.binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
