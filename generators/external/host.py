"""Host: the child process that serves a Python function: `python host.py module:function settings`.

It is run as a file and imports numpy only, so that it starts at once.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any, cast

import numpy as np

from generators.external.npz_writer import write_npz

Grow = Callable[[dict[str, Any], int], object]


def main(name: str, settings: str) -> None:
    """Answer requests until there are no more; what the function prints goes where it disturbs nothing."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8", buffering=1)
    os.dup2(2, 1)
    sys.path[0] = str(Path.cwd())  # where the user's modules are, in place of where this file is
    module, _, function = name.partition(":")
    grow: Grow = getattr(importlib.import_module(module), function)
    serve(grow, sys.stdin, answers, json.loads(settings))


def serve(grow: Grow, requests: IO[str], answers: IO[str], settings: Mapping[str, Any]) -> None:
    """Answer each line of `requests` by a line of `answers`; `settings` are how meshes are read."""
    for line in requests:
        request = json.loads(line)
        answer: dict[str, object] = {"id": request.get("id"), "ok": True}
        try:
            if request.get("ask") == "preset":
                answer["values"] = preset_of(grow)
            else:
                write(arrays_of(grow(request["values"], request["seed"]), settings), request["out"])
        except Exception as error:  # whatever a function raises is an answer
            answer.update(ok=False, error=f"{type(error).__name__}: {error}")
        answers.write(json.dumps(answer) + "\n")


def preset_of(grow: Grow) -> Mapping[str, object]:
    """Example of all values: `PRESET` in the module of the function."""
    preset = getattr(sys.modules[grow.__module__], "PRESET", None)
    if not isinstance(preset, Mapping):
        raise LookupError(f"{grow.__module__} has no PRESET, a dict of example values")
    return preset


def arrays_of(tree: object, settings: Mapping[str, Any]) -> Mapping[str, Any]:
    """Arrays by name, z upwards, of what a function returned: a Plant, such arrays, or a mesh of trimesh."""
    if hasattr(tree, "leaf_position"):
        return vars(tree)
    if isinstance(tree, Mapping):
        return {name: _upright(name, tree[name]) for name in tree} if settings["up"] == "y" else tree
    if hasattr(tree, "faces") or hasattr(tree, "geometry"):
        from generators.external.mesh import Mesh, plant_of_scene

        return vars(plant_of_scene(cast(Any, tree), Mesh(**settings["mesh"]), settings["up"]))
    raise TypeError(f"must return a Plant, arrays by name or a trimesh scene, got {type(tree).__name__}")


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
