"""Host: the child process that serves a Python function: `python host.py module:function up`.

It is run as a file and imports numpy only, so that it starts at once.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np

from generators.external.npz_writer import write_npz

Grow = Callable[[dict[str, Any], int], object]


def main(name: str, up: str) -> None:
    """Answer requests until there are no more; what the function prints goes where it disturbs nothing."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8", buffering=1)
    os.dup2(2, 1)
    sys.path[0] = str(Path.cwd())  # where the user's modules are, in place of where this file is
    module, _, function = name.partition(":")
    grow: Grow = getattr(importlib.import_module(module), function)
    serve(grow, sys.stdin, answers, up)


def serve(grow: Grow, requests: IO[str], answers: IO[str], up: str) -> None:
    """Answer each line of `requests` by a line of `answers`; the axis `up` of the trees, y or z, points upwards."""
    for line in requests:
        request = json.loads(line)
        answer: dict[str, object] = {"id": request.get("id"), "ok": True}
        try:
            if request.get("ask") == "preset":
                answer["values"] = preset_of(grow)
            else:
                hand_over(grow(request["values"], request["seed"]), request["out"], up)
        except Exception as error:  # whatever a function raises is an answer
            answer.update(ok=False, error=f"{type(error).__name__}: {error}")
        answers.write(json.dumps(answer) + "\n")


def preset_of(grow: Grow) -> Mapping[str, object]:
    """Example of all values: `PRESET` in the module of the function."""
    preset = getattr(sys.modules[grow.__module__], "PRESET", None)
    if not isinstance(preset, Mapping):
        raise LookupError(f"{grow.__module__} has no PRESET, a dict of example values")
    return preset


def hand_over(tree: object, out: str, up: str) -> None:
    """Write what a function returned: a Plant or arrays by name as npz, z upwards, a mesh of trimesh as GLB."""
    if hasattr(tree, "leaf_position"):
        write(vars(tree), out)
    elif isinstance(tree, Mapping):
        write({name: _upright(name, tree[name]) for name in tree} if up == "y" else tree, out)
    elif hasattr(tree, "apply_transform") and hasattr(tree, "export"):
        if up == "z":
            tree.apply_transform(_LYING)
        tree.export(out + ".glb")
    else:
        raise TypeError(f"must return a Plant, arrays by name or a trimesh scene, got {type(tree).__name__}")


_LYING = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
"""Turns z upwards into y upwards, as a GLB has it."""


def _upright(name: str, values: object) -> object:
    """Points or directions (any, 3) with y upwards become such with z upwards."""
    if name not in ("position", "leaf_position", "leaf_axis", "leaf_normal"):
        return values
    x, y, z = np.asarray(values).T
    return np.stack([x, -z, y], axis=1)


def write(arrays: Mapping[str, Any], out: str) -> None:
    """Write the fields of a Plant among `arrays` to the file `out`.npz."""
    known = {name: np.asarray(arrays[name]) for name in FIELDS if arrays.get(name) is not None}
    write_npz(out + ".npz", known)


FIELDS = (
    "position", "parent", "radius", "level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size", "complexity",
)  # fmt: skip
"""Fields of a Plant that are handed over."""


if __name__ == "__main__":
    main(*sys.argv[1:])
