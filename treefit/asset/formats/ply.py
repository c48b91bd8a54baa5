"""PLY: the skeleton of a plant as points and edges, in the plant's frame (z up, metres)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from treefit.asset.formats.whole_file import write_whole
from treefit.plant import Plant, check_plant

_VERTEX = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("radius", "<f4"), ("level", "<i4"), ("parent", "<i4")]
_EDGE = [("vertex1", "<i4"), ("vertex2", "<i4")]
_WORDS = {"<f4": "float", "<i4": "int"}


def write_ply(plant: Plant, path: Path | str) -> None:
    """Write the branch graph of `plant` to `path`: vertices with radius, level and parent (root -1), and an edge each.

    Binary, so that it is exact and small; leaves are in the JSON and npz skeletons only.
    """
    check_plant(plant)
    vertices, edges = np.empty(plant.n_vertices, _VERTEX), np.empty(plant.n_vertices - 1, _EDGE)
    for axis, name in enumerate("xyz"):
        vertices[name] = plant.position[:, axis]
    vertices["radius"], vertices["level"], vertices["parent"] = plant.radius, plant.level, plant.parent
    edges["vertex1"], edges["vertex2"] = plant.parent[1:], np.arange(1, plant.n_vertices)
    header = [
        "ply", "format binary_little_endian 1.0", "comment skeleton of a tree by treefit: metres, z up",
        f"element vertex {len(vertices)}", *(f"property {_WORDS[kind]} {name}" for name, kind in _VERTEX),
        f"element edge {len(edges)}", *(f"property {_WORDS[kind]} {name}" for name, kind in _EDGE), "end_header",
    ]  # fmt: skip
    write_whole(path, "\n".join([*header, ""]).encode() + vertices.tobytes() + edges.tobytes())
