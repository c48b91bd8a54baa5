"""Tree file: what a foreign program wrote, arrays as npz or JSON, or a mesh, is read and becomes a Plant."""

from __future__ import annotations

import json
import struct
import zipfile
import zlib
from pathlib import Path

from generators.external.arrays import plant_of
from generators.external.faults import GeneratorFault, NoTree, TooLarge
from generators.external.limits import Limits
from generators.external.mesh import Mesh, read_mesh
from generators.external.npz import read_npz
from treefit.plant import Plant

SUFFIXES = (".npz", ".glb", ".json")


def read_tree(out: Path, limits: Limits, mesh: Mesh, up: str) -> Plant:
    """Plant in the file `out`, or `out` with one of SUFFIXES, which is removed; NoTree or TooLarge when there is none.

    Nothing is loaded before its header shows that it is within the `limits`.
    """
    file = _find(out)
    try:
        if file.stat().st_size > limits.file:
            raise TooLarge(f"its file has {file.stat().st_size // 2**20} MiB, over {limits.file // 2**20}")
        if file.suffix == ".glb":
            return read_mesh(file, mesh, limits.max_vertices)
        arrays = read_npz(file, limits.max_vertices) if file.suffix == ".npz" else json.loads(file.read_bytes())
        plant = plant_of(arrays, up)
        if max(plant.n_vertices, plant.n_leaves) > limits.max_vertices:
            raise TooLarge(f"has {plant.n_vertices:,} vertices, {plant.n_leaves:,} leaves, over generator.max_vertices")
        return plant
    except GeneratorFault:
        raise
    except _DAMAGED as error:
        raise NoTree(" ".join(str(error).split()) or type(error).__name__) from None
    finally:
        file.unlink(missing_ok=True)


_DAMAGED = (
    ValueError, OSError, EOFError, KeyError, IndexError, TypeError, NotImplementedError, RuntimeError, struct.error,
    zipfile.BadZipFile, zlib.error,
)  # fmt: skip
"""What may be raised when a file is read that is none of its kind, or half of one."""


def _find(out: Path) -> Path:
    for file in (out.with_name(out.name + suffix) for suffix in SUFFIXES):
        if file.is_file():
            return file
    if out.suffix in SUFFIXES and out.is_file():
        return out
    raise NoTree(f"said ok, but wrote no {' and no '.join(out.name + suffix for suffix in SUFFIXES)}")
