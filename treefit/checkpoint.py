"""Checkpoint: plain arrays and one JSON text in an npz, written beside and renamed, so that none is ever half."""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from treefit.search.optimizer import State

Meta = dict[str, object]


class CheckpointError(ValueError):
    """A checkpoint that is damaged or belongs to another run; the message is one line."""


def write_checkpoint(path: Path, arrays: State, meta: Mapping[str, object]) -> None:
    """Write `arrays` and `meta` (JSON values) to `path`; the old file stays whole until the new one is."""
    text = np.frombuffer(json.dumps(meta, allow_nan=False).encode(), np.uint8)
    whole = {"meta": text, **{f"state_{name}": np.asarray(array) for name, array in arrays.items()}}
    unfinished = path.with_name(path.name + ".tmp")
    with unfinished.open("wb") as file:
        np.savez(file, allow_pickle=False, digest=_digest(whole), **whole)
        file.flush()
        os.fsync(file.fileno())
    unfinished.replace(path)


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
    except (OSError, ValueError, KeyError, EOFError, NotImplementedError, zipfile.BadZipFile, zlib.error) as error:
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
