"""Npz: arrays in a file without pickle, which is written beside and renamed, so that none is ever half."""

from __future__ import annotations

import os
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

DAMAGED = (
    OSError, ValueError, TypeError, KeyError, EOFError, NotImplementedError, zipfile.BadZipFile, zlib.error,
)  # fmt: skip
"""What may be raised when a file is read that was cut, changed, or never was one of ours."""


def write_npz(path: Path, arrays: Mapping[str, NDArray[Any]], compressed: bool = False) -> None:
    """Write `arrays` to `path`; the old file stays whole until the new one is."""
    unfinished = path.with_name(path.name + ".tmp")
    with unfinished.open("wb") as file:
        (np.savez_compressed if compressed else np.savez)(file, allow_pickle=False, **dict(arrays))
        file.flush()
        os.fsync(file.fileno())
    unfinished.replace(path)
