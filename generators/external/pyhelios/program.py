"""Program: grows a tree with the package PyHelios, in a child process; knows nothing of searches."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from generators.external.pyhelios.primitives import Points, build, build_lines
from generators.external.pyhelios.skeleton import Forks, skeleton_of
from generators.external.pyhelios.tubes import tubes_of

if TYPE_CHECKING:
    import trimesh

    from treefit.plant import Value

Arrays = dict[str, NDArray[np.float32] | NDArray[np.int32]]

SCENE_SIDES = 6
"""Corners of a tube of a scene: by their angle a reader of meshes sees that it is round."""


def grow(values: Mapping[str, Value], seed: int) -> Arrays:
    """Arrays under the names of a Plant's fields, of the tree with the parameters `values`; see space.yaml."""
    made = build_lines(values, seed)
    forked = int(values["BaseSplits"]) > 0
    splits = tuple(math.ceil(float(values.get(f"nSegSplits.{n}", 0))) + 1 for n in range(4))
    pieces = tuple(int(values.get(f"nCurveRes.{n}", 0)) for n in range(4))
    forks = Forks(forked, tuple(0 if n == 1 else n for n in splits), pieces)
    skeleton = skeleton_of(tubes_of(made.trunk, made.branches, forked), forks)
    return {
        "position": skeleton.position, "radius": skeleton.radius, "parent": skeleton.parent, "level": skeleton.level,
        **leaves_of(made.leaves),
    }  # fmt: skip


def leaves_of(quads: Points) -> Arrays:
    """Fields of the leaves in the rectangles (k, 4, 3): sides 3-0 at the twig and 1-2 at the tip."""
    along, across = quads[:, 1] - quads[:, 0], quads[:, 3] - quads[:, 0]
    size = np.sqrt(np.stack([(along * along).sum(axis=1), (across * across).sum(axis=1)], axis=1))
    return {
        "leaf_position": quads[:, 0] + across / 2, "leaf_axis": along / size[:, :1],
        "leaf_normal": np.cross(along, across) / (size[:, :1] * size[:, 1:]), "leaf_size": size,
    }  # fmt: skip


def scene(values: Mapping[str, Value], seed: int, sides: int = SCENE_SIDES) -> trimesh.Scene:
    """Return the same tree as a mesh, z upwards, in parts trunk, branch and leaf."""
    import trimesh

    made = build(values, seed, sides)
    trunk = made.trunk if int(values["BaseSplits"]) > 0 else made.trunk[: -2 * sides]  # its tip leads back to its foot
    leaves = np.concatenate([made.leaves[:, :3], made.leaves[:, [0, 2, 3]]])
    parts = {"trunk": trunk, "branch": made.branches, "leaf": leaves}
    made_of = trimesh.Scene()
    for name, triangles in parts.items():
        if len(triangles):
            made_of.add_geometry(_mesh(triangles), geom_name=name)
    return made_of


def _mesh(triangles: Points) -> trimesh.Trimesh:
    import trimesh

    return trimesh.Trimesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3), process=False)
