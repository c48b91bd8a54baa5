"""ONNX files of one convolution, written field by field: the tests do not need the onnx package."""

from __future__ import annotations

from pathlib import Path

import numpy as np

FLOAT, HALF = 1, 10
Side = int | str


def write_model(
    path: Path,
    weights: object,
    *,
    sides: tuple[Side, ...] = (1, 3, "h", "w"),
    last: str = "Identity",
    number: int = FLOAT,
) -> Path:
    """Write a model: `last`(convolution by `weights` (c, 3), no neighbours) of an input of `sides`."""
    kernel = np.asarray(weights, np.float32)
    kernel = kernel.astype(np.float16 if number == HALF else np.float32)[:, :, None, None]
    tensor = b"".join(_number(1, side) for side in kernel.shape)
    tensor += _number(2, number) + _bytes(8, b"kernel") + _bytes(9, kernel.tobytes())
    graph = _node("Conv", ("picture", "kernel"), "c") + _node(last, ("c",), "classes", axis=1)
    graph += _bytes(2, b"graph") + _bytes(5, tensor)
    graph += _bytes(11, _value("picture", sides, number)) + _bytes(12, _value("classes", None, number))
    opset = _bytes(1, b"") + _number(2, 17)
    path.write_bytes(_number(1, 8) + _bytes(7, graph) + _bytes(8, opset))
    return path


def _node(kind: str, inputs: tuple[str, ...], output: str, axis: int | None = None) -> bytes:
    node = b"".join(_bytes(1, name.encode()) for name in inputs) + _bytes(2, output.encode()) + _bytes(4, kind.encode())
    if axis is not None and kind == "Softmax":
        node += _bytes(5, _bytes(1, b"axis") + _number(3, axis) + _number(20, 2))
    return _bytes(1, node)


def _value(name: str, sides: tuple[Side, ...] | None, number: int) -> bytes:
    kind = _number(1, number)
    if sides is not None:
        kind += _bytes(2, b"".join(_bytes(1, _side(side)) for side in sides))
    return _bytes(1, name.encode()) + _bytes(2, _bytes(1, kind))


def _side(side: Side) -> bytes:
    return _number(1, side) if isinstance(side, int) else _bytes(2, side.encode())


def _bytes(field: int, content: bytes) -> bytes:
    """Field of protocol buffers with a length."""
    return _varint(field << 3 | 2) + _varint(len(content)) + content


def _number(field: int, value: int) -> bytes:
    return _varint(field << 3) + _varint(value)


def _varint(value: int) -> bytes:
    low, rest = value & 0x7F, value >> 7
    return bytes([low | 0x80]) + _varint(rest) if rest else bytes([low])
