"""Checkpoint: plain arrays and one JSON text in an npz, with a digest of it all."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from treefit.npz import DAMAGED, write_npz
from treefit.search.optimizer import State

Meta = dict[str, object]


class CheckpointError(ValueError):
    """A checkpoint that is damaged or belongs to another run; the message is one line."""


def write_checkpoint(path: Path, arrays: State, meta: Mapping[str, object]) -> None:
    """Write `arrays` and `meta` (JSON values) to `path`; the old file stays whole until the new one is."""
    text = np.frombuffer(json.dumps(meta, allow_nan=False).encode(), np.uint8)
    whole = {"meta": text, **{f"state_{name}": np.asarray(array) for name, array in arrays.items()}}
    write_npz(path, {"digest": _digest(whole), **whole})


def read_checkpoint(path: Path) -> tuple[dict[str, NDArray[np.generic]], Meta]:
    """Arrays and meta of `path`; CheckpointError when it is damaged, FileNotFoundError when there is none."""
    try:
        with np.load(path, allow_pickle=False) as file:
            whole = {name: file[name] for name in file.files if name != "digest"}
            if (file["digest"] != _digest(whole)).any():
                raise ValueError("its digest is wrong")
        meta = json.loads(bytes(whole.pop("meta")).decode())
    except FileNotFoundError:
        raise
    except DAMAGED as error:
        raise CheckpointError(
            f"{path}: damaged checkpoint ({type(error).__name__}); delete it to start anew"
        ) from error
    return {name.removeprefix("state_"): array for name, array in whole.items()}, meta


def _digest(arrays: Mapping[str, NDArray[np.generic]]) -> NDArray[np.uint8]:
    """Hash of names, types, shapes and bytes, in the order of the names."""
    found = hashlib.sha256()
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        found.update(f"{name} {array.dtype.str} {array.shape}".encode() + array.tobytes())
    return np.frombuffer(found.digest(), np.uint8)
