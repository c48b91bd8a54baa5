"""Files of the family: arrays and a head of plain values in an npz without pickle, at once or not at all."""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from treefit.family.identity import FamilyError

FORMAT = 1

Made = TypeVar("Made")


def write_arrays(path: Path, head: Mapping[str, object], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write `head` (JSON values) and `arrays` to `path`."""
    text = json.dumps({"format": FORMAT, **head}, allow_nan=False).encode()
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".tmp")
    with unfinished.open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, head=np.frombuffer(text, np.uint8), **dict(arrays))
        file.flush()
        os.fsync(file.fileno())
    unfinished.replace(path)


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
    except (OSError, ValueError, TypeError, KeyError, EOFError, NotImplementedError, zipfile.BadZipFile,
            zlib.error) as error:  # fmt: skip
        why = " ".join(str(error).split()) or type(error).__name__
        raise FamilyError(f"{what} {path}: damaged ({why}); delete the file") from error


def array(arrays: Mapping[str, NDArray[Any]], name: str, kind: type[np.generic]) -> NDArray[Any]:
    """Array `name`, which must be of this `kind` of numbers."""
    if arrays[name].dtype != kind:
        raise ValueError(f"{name} must be {kind.__name__}, got {arrays[name].dtype}")
    return arrays[name]
