"""An ONNX file becomes a function from pixels to channels; the only place that knows onnxruntime."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from onnxruntime import InferenceSession

Channels = NDArray[np.float32]
"""(c, h, w) float32, what a network says of each pixel."""

INPUTS = {"tensor(float)": np.float32, "tensor(float16)": np.float16}
WANTED = "one input (1, 3, height, width) and one output (1, classes, height, width) of floating point numbers"


class ModelError(ValueError):
    """The model file cannot be used; the message is one line saying why and what to do instead."""


class NoRuntimeError(ModelError):
    """onnxruntime is not there, or does not load on this machine."""


def run_model(path: Path, pixels: NDArray[np.float32]) -> Channels:
    """First output of the model at `path` for `pixels` (h, w, 3); one thread, the same bytes for the same pixels."""
    session = _session(path)
    entry = session.get_inputs()[0]
    batch = np.ascontiguousarray(pixels.transpose(2, 0, 1)[None]).astype(INPUTS[entry.type])
    try:
        found = np.asarray(session.run(None, {entry.name: batch})[0])
    except Exception as error:  # onnxruntime has a type of its own for each state, none of them public
        sides = f"{pixels.shape[1]} x {pixels.shape[0]}"
        raise ModelError(
            f"{path}: the model failed on {sides} pixels ({_one_line(error)}); try another size"
        ) from error
    if found.ndim != 4 or len(found) != 1 or found.dtype not in (np.float32, np.float16):
        raise ModelError(f"{path}: its output is {found.dtype} {found.shape}; needed is {WANTED}")
    if not np.isfinite(found).all():
        raise ModelError(f"{path}: its output is not finite; mean and std are perhaps not those of its training")
    return np.asarray(found[0], np.float32)


def fixed_sides(path: Path) -> tuple[int, int] | None:
    """Height and width when the model at `path` takes pictures of one size only."""
    height, width = _session(path).get_inputs()[0].shape[2:]
    return (height, width) if isinstance(height, int) and isinstance(width, int) else None


def _session(path: Path) -> InferenceSession:
    if not path.is_file():
        raise ModelError(f"{path}: no such model file; give an ONNX file")
    facts = path.stat()
    return _load(path.resolve(), facts.st_mtime_ns, facts.st_size)


@lru_cache(maxsize=4)
def _load(path: Path, _time: int, _size: int) -> InferenceSession:
    """Session of `path`, kept for the pictures to come; time and size tell when the file was written anew."""
    try:
        import onnxruntime
    except ImportError as error:
        raise NoRuntimeError("a mask network needs onnxruntime: python -m pip install onnxruntime") from error
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 4  # what is wrong becomes one line below
    try:
        session = onnxruntime.InferenceSession(path, options, providers=["CPUExecutionProvider"])
    except Exception as error:  # as in run_model
        raise ModelError(f"{path}: not an ONNX file that can be run ({_one_line(error)})") from error
    entries = session.get_inputs()
    shape = entries[0].shape if entries else []
    if len(entries) != 1 or len(shape) != 4 or (isinstance(shape[1], int) and shape[1] != 3):
        found = ", ".join(f"{entry.name} {entry.shape}" for entry in entries) or "no input"
        raise ModelError(f"{path}: it takes {found}; needed is {WANTED}")
    if entries[0].type not in INPUTS:
        raise ModelError(f"{path}: it takes {entries[0].type}; needed is {WANTED}")
    return session


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())[:200] or type(error).__name__
