"""Files of the family: arrays and a head of plain values in an npz, checked when they are read."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from treefit.family.identity import FamilyError
from treefit.npz import DAMAGED, write_npz

FORMAT = 1

Made = TypeVar("Made")


def write_arrays(path: Path, head: Mapping[str, object], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write `head` (JSON values) and `arrays` to `path`."""
    text = json.dumps({"format": FORMAT, **head}, allow_nan=False).encode()
    path.parent.mkdir(parents=True, exist_ok=True)
    write_npz(path, {"head": np.frombuffer(text, np.uint8), **arrays}, compressed=True)


def read_arrays(path: Path, what: str, make: Callable[[Any, Mapping[str, NDArray[Any]]], Made]) -> Made:
    """What `make` makes of head and arrays in `path`; FamilyError that names `what` when they are damaged."""
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files if name != "head"}
            head = json.loads(bytes(file["head"]).decode())
        if head["format"] != FORMAT:
            raise ValueError(f"format {head['format']!r}, not {FORMAT}")
        return make(head, arrays)
    except FileNotFoundError:
        raise
    except DAMAGED as error:
        why = " ".join(str(error).split()) or type(error).__name__
        raise FamilyError(f"{what} {path}: damaged ({why}); delete the file") from error


def array(arrays: Mapping[str, NDArray[Any]], name: str, kind: type[np.generic]) -> NDArray[Any]:
    """Array `name`, which must be of this `kind` of numbers."""
    if arrays[name].dtype != kind:
        raise ValueError(f"{name} must be {kind.__name__}, got {arrays[name].dtype}")
    return arrays[name]
