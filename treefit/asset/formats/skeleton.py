"""Skeleton: a plant as plain arrays under the names of its fields, as JSON or npz, and read back exactly."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from treefit.asset.formats.text_rows import text_rows
from treefit.asset.formats.whole_file import write_whole
from treefit.npz import DAMAGED, write_npz
from treefit.plant import Look, Plant, check_plant

UNITS = {
    "position": "m, x y z, z up, the root is the origin; vertex i is joined to vertex parent[i]",
    "radius": "m",
    "parent": "index of a vertex, -1 for the root",
    "level": "0 is the trunk",
    "leaf_position": "m, where the leaf is attached",
    "leaf_axis": "unit vector from the attachment to the tip",
    "leaf_normal": "unit vector at right angles to the axis",
    "leaf_size": "m, length and width",
}
"""What each array holds, as the files say it."""

_WHOLE = ("parent", "level")
_WIDTHS = {"position": 3, "leaf_position": 3, "leaf_axis": 3, "leaf_normal": 3, "leaf_size": 2}


def write_skeleton_json(plant: Plant, path: Path | str) -> None:
    """Write `plant` as JSON; numbers have the nine digits that a float32 needs to be the same again."""
    about = {"what": "skeleton of a tree", "units": UNITS, "cut": plant.cut,
             "look": None if plant.look is None else asdict(plant.look)}  # fmt: skip
    parts = [f'"{name}": {json.dumps(value, ensure_ascii=False)}' for name, value in about.items()]
    parts += [f'"{name}": [{_listed(name, values)}]' for name, values in _arrays(plant).items()]
    write_whole(path, ("{\n" + ",\n".join(parts) + "\n}\n").encode())


def write_skeleton_npz(plant: Plant, path: Path | str) -> None:
    """Write `plant` as npz without pickle; `units`, `look` and `cut` are JSON text."""
    about = {"units": UNITS, "cut": plant.cut, "look": None if plant.look is None else asdict(plant.look)}
    texts = {name: np.array(json.dumps(value, ensure_ascii=False)) for name, value in about.items()}
    write_npz(Path(path), {**_arrays(plant), **texts}, compressed=True)


def read_skeleton(path: Path | str) -> Plant:
    """Return the plant of a skeleton file (.json or .npz); ValueError when it is none or is damaged."""
    path = Path(path)
    try:
        content: dict[str, Any] = (
            _read_npz(path) if path.suffix == ".npz" else json.loads(path.read_text(encoding="utf-8"))
        )
        look = None if content["look"] is None else Look(**content["look"])
        arrays: dict[str, Any] = {name: _array(name, content[name]) for name in UNITS}
        plant = Plant(**arrays, cut=bool(content["cut"]), look=look)
    except FileNotFoundError:
        raise
    except DAMAGED as error:
        raise ValueError(f"skeleton {path}: not a skeleton file of treefit, or damaged ({error!r})") from error
    check_plant(plant)
    return plant


def _arrays(plant: Plant) -> dict[str, NDArray[np.generic]]:
    check_plant(plant)
    kinds = {name: np.int32 if name in _WHOLE else np.float32 for name in UNITS}
    return {name: np.ascontiguousarray(getattr(plant, name), dtype=kinds[name]) for name in UNITS}


def _listed(name: str, values: NDArray[np.generic]) -> str:
    number = "%d" if name in _WHOLE else "%.9g"
    row = f"[{','.join([number] * _WIDTHS[name])}]" if name in _WIDTHS else number
    return text_rows(values, row + ",").removesuffix(",")


def _read_npz(path: Path) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as content:
        texts = {name: json.loads(str(content[name])) for name in ("cut", "look")}
        return {**{name: content[name] for name in UNITS}, **texts}


def _array(name: str, values: object) -> NDArray[np.generic]:
    array = np.asarray(values, dtype=np.int32 if name in _WHOLE else np.float32)
    return array.reshape(-1, _WIDTHS[name]) if name in _WIDTHS and array.size == 0 else array
