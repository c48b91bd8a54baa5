"""Program: grows a tree with the package modular-tree, in a child process; knows nothing of searches."""

from __future__ import annotations

from collections.abc import Mapping

import m_tree
import numpy as np
from numpy.typing import NDArray

from generators.external.modular_tree.foliage import LeafRule, leaves_of
from generators.external.modular_tree.skeleton import skeleton_of
from treefit.plant import Value
from treefit.plant.streams import child_key, seed_key

LEAVES = ("density", "length", "width", "angle", "droop", "thin")
"""Parameters of the foliage, which is this adapter's own."""

_SEEDS = np.uint32(0x7FFFFFFF)  # the package's seeds are signed


def grow(values: Mapping[str, Value], seed: int) -> dict[str, NDArray[np.float32] | NDArray[np.int32]]:
    """Arrays under the names of a Plant's fields, of the tree with the parameters `values`; see space.yaml."""
    mesh = m_tree.BasicMesher().mesh_tree(tree_of(values, seed))
    skeleton = skeleton_of(mesh.get_vertices(), mesh.get_polygons())
    leaves = leaves_of(skeleton, LeafRule(**{name: float(values[f"leaves.{name}"]) for name in LEAVES}), seed)
    scale = np.float32(values["scale"])
    return {
        "position": skeleton.position * scale, "radius": skeleton.radius * scale,
        "parent": skeleton.parent, "level": skeleton.level,
        "leaf_position": leaves[:, :3] * scale, "leaf_axis": leaves[:, 3:6], "leaf_normal": leaves[:, 6:9],
        "leaf_size": leaves[:, 9:] * scale,
    }  # fmt: skip


def tree_of(values: Mapping[str, Value], seed: int) -> m_tree.Tree:
    """The package's tree, grown: branches on a trunk, twigs on the branches."""
    trunk, branches, twigs = m_tree.TrunkFunction(), m_tree.BranchFunction(), m_tree.BranchFunction()
    for part, function in enumerate((trunk, branches, twigs)):
        function.seed = int(child_key(seed_key(seed), part) & _SEEDS)
    for name, value in values.items():
        if name.startswith("trunk."):
            setattr(trunk, name.removeprefix("trunk."), float(value))
    _set_branches(branches, "branches.", values)
    _set_branches(twigs, "twigs.", values)
    branches.add_child(twigs)
    trunk.add_child(branches)
    tree = m_tree.Tree()
    tree.set_trunk_function(trunk)
    tree.execute_functions()
    return tree


def _set_branches(function: m_tree.BranchFunction, prefix: str, values: Mapping[str, Value]) -> None:
    """Give `function` the values under `prefix`; a pair .start, .end is a line from the parent's foot to its tip."""
    for name, value in values.items():
        if not name.startswith(prefix):
            continue
        path = name.removeprefix(prefix)
        part, _, inner = path.partition(".")
        if part in ("length", "start_angle"):
            if inner == "start":
                line = m_tree.SimpleCurveProperty()
                line.x_min, line.x_max, line.power = 0.0, 1.0, 1.0
                line.y_min, line.y_max = float(value), float(values[f"{prefix}{part}.end"])
                getattr(function, part).set_simple_curve_property(line)
        elif part in ("randomness", "start_radius"):
            getattr(function, part).set_constant_property(m_tree.ConstantProperty(float(value)))
        elif path == "crown.shape":
            function.crown.shape = getattr(m_tree.CrownShape, str(value))
        elif inner:
            setattr(getattr(function, part), inner, float(value))
        else:
            setattr(function, part, float(value))
