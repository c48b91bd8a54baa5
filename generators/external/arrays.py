"""Arrays: what a foreign generator gives, under the names of a Plant's fields, becomes a Plant."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generators.external.graph import levels_of, order_of
from treefit.plant import Plant, check_plant

NEEDED = ("position", "parent", "radius")
OPTIONAL = ("level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size", "complexity")
FIELDS = (*NEEDED, *OPTIONAL)

FARTHEST = 1e5
"""Metres from the root beyond which nothing of a tree can be."""

Numbers = NDArray[np.float32]
Arrays = Mapping[str, ArrayLike]


def plant_of(arrays: Arrays, up: str = "z") -> Plant:
    """Plant of `arrays` under the names of its fields, with the axis `up` ("z" or "y") pointing upwards.

    Vertices may come in any order; the root moves to the origin. Without `level` a stem goes on where its child is
    thickest, and every other child begins a stem. Directions of leaves are made unit, and normals that are left out
    point upwards. `complexity` is the count of vertices as the generator counts them. ValueError with one line for what
    is wrong: a loop, several roots, numbers that are not finite.
    """
    missing = [name for name in NEEDED if name not in arrays]
    if missing:
        raise ValueError(f"tree: lacks {', '.join(missing)}: the arrays are {', '.join(FIELDS)}")
    position, radius = _rows("position", arrays["position"], 3, up), _numbers("radius", arrays["radius"], 1)
    parent = _whole("parent", arrays["parent"], len(radius))
    if position.shape[1] != len(radius):
        raise ValueError(f"tree: position and radius must be as many, are {position.shape[1]} and {len(radius)}")
    if len(radius) < 2:
        raise ValueError(f"tree: is empty, it has {len(radius)} vertices and needs 2")
    level = _whole("level", arrays["level"], len(radius)) if arrays.get("level") is not None else None
    order = order_of(parent)
    if order is not None:
        place = np.empty_like(order)
        place[order] = np.arange(len(order), dtype=np.int32)
        parent = np.concatenate([parent[order[:1]], place[parent[order[1:]]]])
        position, radius = position[:, order], radius[order]
        level = level if level is None else level[order]
    if level is None:
        level = levels_of(parent, radius)
    root = position[:, :1].copy()
    position -= root
    complexity = float(np.asarray(arrays["complexity"])) if "complexity" in arrays else None
    plant = Plant(position.T, radius, parent, level, *_leaves(arrays, root, up), complexity=complexity)
    check_plant(plant)
    _check_size(plant)
    return plant


def _leaves(arrays: Arrays, root: Numbers, up: str) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """Position, axis, normal (k, 3) and size (k, 2) of the leaves."""
    given = arrays.get("leaf_position")
    if given is None or np.size(given) == 0:
        return (*(np.zeros((0, 3), np.float32) for _ in range(3)), np.zeros((0, 2), np.float32))  # type: ignore[return-value]
    position = _rows("leaf_position", given, 3, up) - root
    count = position.shape[1]
    if "leaf_axis" not in arrays or "leaf_size" not in arrays:
        raise ValueError("tree: leaf_position needs leaf_axis and leaf_size beside it")
    along, size = _unit("leaf_axis", _rows("leaf_axis", arrays["leaf_axis"], 3, up)), arrays["leaf_size"]
    upwards = np.repeat(np.array([[0], [0], [1]], np.float32), count, axis=1)
    across = _rows("leaf_normal", arrays["leaf_normal"], 3, up) if "leaf_normal" in arrays else upwards
    if along.shape[1] != count or across.shape[1] != count:
        raise ValueError(f"tree: leaf_axis and leaf_normal must have shape ({count}, 3) as leaf_position has")
    sizes = _numbers("leaf_size", size, 2)
    if sizes.shape != (count, 2):
        raise ValueError(f"tree: leaf_size must have shape ({count}, 2), length and width, got {sizes.shape}")
    if (sizes < 0).any():
        raise ValueError("tree: leaf_size must not be negative")
    return position.T, along.T, _square_to(along, across).T, np.ascontiguousarray(sizes.T).T


def _unit(name: str, rows: Numbers) -> Numbers:
    length = np.sqrt((rows * rows).sum(axis=0))
    if not (length > 0).all():
        raise ValueError(f"tree: {name} must not be of length 0 (leaf {int(np.argmin(length > 0))})")
    rows /= length
    return rows


def _square_to(along: Numbers, across: Numbers) -> Numbers:
    """Unit rows at right angles to `along`, near to `across`; any such where both are parallel."""
    flat = across - along * (along * across).sum(axis=0)
    length = np.sqrt((flat * flat).sum(axis=0))
    poor = ~(length > 1e-4)
    if poor.any():
        x, y, z = along[:, poor]
        flat[:, poor] = np.where(np.abs(z) < 0.9, np.array([-y, x, 0 * z]), np.array([0 * x, -z, y]))
        length[poor] = np.sqrt((flat[:, poor] ** 2).sum(axis=0))
    square: Numbers = flat / length
    return square


def _rows(name: str, values: ArrayLike, width: int, up: str) -> Numbers:
    """Contiguous rows x, y, z (3, v) of an array (v, 3), z upwards; always a copy."""
    array = _numbers(name, values, 2)
    if array.shape[1] != width:
        raise ValueError(f"tree: {name} must have shape (any, {width}), got {array.shape}")
    x, y, z = array.T
    return np.array([x, y, z] if up == "z" else [x, -z, y], np.float32)


def _numbers(name: str, values: ArrayLike, axes: int) -> Numbers:
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"tree: {name} must be numbers, got {array.dtype}")
    if array.ndim != axes:
        raise ValueError(f"tree: {name} must have {axes} axes, got the shape {array.shape}")
    with np.errstate(over="ignore"):
        return array.astype(np.float32, copy=False)


def _whole(name: str, values: ArrayLike, count: int) -> NDArray[np.int32]:
    array = np.asarray(values)
    if array.shape != (count,):
        raise ValueError(f"tree: {name} must have shape ({count},), got {array.shape}")
    if array.dtype.kind not in "iu" and not (array.dtype.kind == "f" and (array == np.floor(array)).all()):
        raise ValueError(f"tree: {name} must be whole numbers, got {array.dtype}")
    if count and (array.min() < -1 or array.max() >= 2**31):
        raise ValueError(f"tree: {name} must be from -1 to 2147483647, got {array.min()} to {array.max()}")
    return array.astype(np.int32)


def _check_size(plant: Plant) -> None:
    low, high = plant.position.min(axis=0), plant.position.max(axis=0)
    if max(-low.min(), high.max()) > FARTHEST:
        raise ValueError(f"tree: reaches {max(-low.min(), high.max()):.3g} m from its root, over {FARTHEST:g}")
    if not (high - low).max() > 0:
        raise ValueError("tree: all of its vertices are at one place")
