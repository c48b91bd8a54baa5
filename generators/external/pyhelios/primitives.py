"""Primitives: a tree of the package PyHelios as the triangles and leaves that it makes; knows nothing of graphs."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from pyhelios import Context, WeberPennTree
from pyhelios.plugins import helios_lib
from pyhelios.WeberPennTree import WeberPennTreeParameters

if TYPE_CHECKING:
    from treefit.plant import Value

SIDES = 3
"""Corners of a tube, the fewest there are: the time goes by the count of triangles."""

SHAPES = (
    "conical", "spherical", "hemispherical", "cylindrical", "tapered_cylindrical", "flame",
    "inverse_conical", "tend_flame",
)  # fmt: skip
"""Words for the package's numbers of the envelope, in their order."""

_LEVELS, _NAME = 4, "treefit"
_FIELDS = {field.name: field for field in fields(WeberPennTreeParameters)}
_LISTS = tuple(name for name in _FIELDS if name[0] == "n" and name[1].isupper())
_WHOLE = ("BaseSplits", "BaseSplitsV", "Levels", "Leaves", "nCurveRes", "nBranches")
_LEAF = "plugins/weberpenntree/leaves/AlmondLeaf.png"  # a picture there must be; what shows on it changes no geometry
_TRIANGLE, _QUAD = 3, 4
_SEEDS = 2**31 - 2  # the package has no more: 0 is as 1 for it, and its first draws go with the size of the seed

Points = NDArray[np.float32]
Ids = NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Primitives:
    """Trunk (t, c, 3) and branches (b, c, 3), c corners of triangles in the order of their making; leaves (k, 4, 3) m.

    Six triangles of a tube of three sides are a segment. A branch comes after all that grow on it.
    """

    trunk: Points
    branches: Points
    leaves: Points


def build(values: Mapping[str, Value], seed: int, sides: int = SIDES) -> Primitives:
    """Return all primitives of the tree with the parameters `values`, its tubes with `sides` corners."""
    return _built(values, seed, sides, lambda ids: ids)


def build_lines(values: Mapping[str, Value], seed: int) -> Primitives:
    """Return the same with every other triangle of a tube: corners 0, 1 of three of them are the rings of a segment."""
    return _built(values, seed, SIDES, lambda ids: np.ascontiguousarray(ids[1::2]))


def parameters_of(values: Mapping[str, Value]) -> WeberPennTreeParameters:
    """Return the package's parameters: `Ratio` is a number of the tree, `nCurve.1` the number of level 1 in a list.

    `Shape` is a word of SHAPES. ValueError for a name that the package does not have; what is missing is 0.
    """
    told: dict[str, Any] = {name: [0] * _LEVELS for name in _LISTS}
    for name, value in values.items():
        field, _, level = name.partition(".")
        number = SHAPES.index(str(value)) if field == "Shape" else int(value) if field in _WHOLE else value
        if field in _LISTS and level in ("0", "1", "2", "3"):
            told[field][int(level)] = number
        elif not level and field in _FIELDS and field not in _LISTS:
            told[field] = number
        else:
            raise ValueError(f"pyhelios: no parameter {name!r}: names are such as Ratio and nCurve.1")
    return WeberPennTreeParameters(**{"LeafFile": _LEAF, "WoodFile": "none", "leafAngleCDF": [], **told})


def _built(values: Mapping[str, Value], seed: int, sides: int, some: Callable[[Ids], Ids]) -> Primitives:
    parameters = parameters_of(values)
    with Context() as context, WeberPennTree(context) as maker:
        maker.setTreeParameters(_NAME, parameters)
        maker.setTrunkSegmentResolution(sides)
        maker.setBranchSegmentResolution(sides)
        maker.setLeafSubdivisions(1, 1)
        maker.setBranchRecursionLevel(_LEVELS)
        maker.seedRandomGenerator(int(np.random.SeedSequence(seed).generate_state(1)[0]) % _SEEDS + 1)
        tree = maker.buildTree(_NAME)
        trunk, branches = (_corners(context, some(_ids(maker, tree, part)), _TRIANGLE) for part in ("Trunk", "Branch"))
        return Primitives(trunk, branches, _corners(context, _ids(maker, tree, "Leaf"), _QUAD))


def _ids(maker: WeberPennTree, tree: int, part: str) -> Ids:
    """Return the numbers of primitives (n,); the package's own getter makes a list of Python numbers of them."""
    count = ctypes.c_uint()
    found = getattr(helios_lib, f"getWeberPennTree{part}UUIDs")(maker.getNativePtr(), tree, ctypes.byref(count))
    return np.ctypeslib.as_array(found, (count.value,)).copy() if count.value else np.empty(0, np.uint32)


def _corners(context: Context, ids: Ids, corners: int) -> Points:
    """Return the corners of primitives (n, corners, 3)."""
    if not len(ids):
        return np.empty((0, corners, 3), np.float32)
    whole, offsets, count = ctypes.POINTER(ctypes.c_uint), np.empty(len(ids) + 1, np.uint32), ctypes.c_uint()
    found = helios_lib.getBatchPrimitiveVertices(
        context.getNativePtr(), ids.ctypes.data_as(whole), len(ids), offsets.ctypes.data_as(whole), ctypes.byref(count)
    )
    return np.ctypeslib.as_array(found, (count.value,)).reshape(-1, corners, 3).copy()
