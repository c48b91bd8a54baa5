"""Functions that grow trees, as users have them: each returns what `generator.callable` may return.

Heavy imports are in the functions: each test starts a process that imports this.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import trimesh

    from treefit.plant import Plant

PRESET = {"height": 8.0, "kind": "oak"}
POLE = {"position": [[0, 0, 0], [0, 0, 1], [0, 0, 2]], "parent": [-1, 0, 1], "radius": [0.2, 0.1, 0.05]}


def arrays(values: dict[str, Any], seed: int) -> dict[str, Any]:
    """A pole as high as wanted, and a lot of words."""
    print('{"id": 1, "ok": true}', "growing", flush=True)
    print("growing", file=sys.stderr)
    return {**POLE, "position": np.array(POLE["position"]) * values["height"] / 2}


def lying(values: dict[str, Any], seed: int) -> dict[str, Any]:
    """The same with y upwards."""
    return {**POLE, "position": [[0, 0, 0], [0, 3, 0], [1, 6, 0]]}


def plant(values: dict[str, Any], seed: int) -> Plant:
    """A Plant with one leaf."""
    from treefit.plant import Plant

    one = np.array([[1, 0, 0]], np.float32)
    return Plant(np.array(POLE["position"], np.float32), np.array(POLE["radius"], np.float32),
                 np.array(POLE["parent"], np.int32), np.zeros(3, np.int32), one, one, one[:, [1, 2, 0]],
                 np.array([[0.5, 0.25]], np.float32))  # fmt: skip


def scene(values: dict[str, Any], seed: int) -> trimesh.Scene:
    """A trunk of a mesh with a leaf beside it."""
    import trimesh

    trunk = trimesh.creation.cylinder(0.2, segment=[[0, 0, 0], [0, 0, values["height"]]], sections=8)
    leaf = trimesh.Trimesh([[0, 0, 4], [1, 0, 4.5], [1, 0, 4], [0, 0, 4.5]], [[0, 1, 2], [0, 3, 1]], process=False)
    return trimesh.Scene({"trunk": trunk, "leaf": leaf})


def lying_scene(values: dict[str, Any], seed: int) -> trimesh.Scene:
    """The same with y upwards."""
    found = scene(values, seed)
    found.apply_transform([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
    return found


def raises(values: dict[str, Any], seed: int) -> object:
    """Nothing but an error over two lines."""
    raise LookupError("no bark\nleft")


def nothing(values: dict[str, Any], seed: int) -> object:
    """No tree at all."""
    return None
