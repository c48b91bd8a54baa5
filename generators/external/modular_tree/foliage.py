"""Foliage: the leaves that treefit adds to the wood of modular-tree, which makes none.

The rule: wood thinner than a share of the trunk's foot bears leaves, so many a metre, counted from the tip of a stem:
the first goes on where the stem ends, the others stand around it in a spiral. A leaf's draws are keyed by the seed,
the stem (which of its parent's, and so on down to the trunk) and its count from the tip.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.external.modular_tree.skeleton import Floats, Ints, Skeleton
from treefit.plant.compiling import FAST, INNER
from treefit.plant.streams import child_key, seed_key, uniform

_TURN = math.radians(137.5)  # from a leaf to the next
_FOLIAGE, _START, _STEP, _SIZE, _TILT_X, _TILT_Y = 7, 0, 1, 2, 3, 4  # parts and purposes of draws

Keys = NDArray[np.uint32]


@dataclass(frozen=True)
class LeafRule:
    """Where leaves stand and how large they are."""

    density: float  # per metre of wood that bears leaves
    length: float  # m, of the mean leaf; a leaf has 0.75 to 1.25 of it
    width: float  # by the length
    angle: float  # degrees between the twig and its leaves
    droop: float  # how much of gravity is added to the leaf's direction
    thin: float  # radius below which wood bears leaves, by that of the trunk's foot


def leaves_of(skeleton: Skeleton, rule: LeafRule, seed: int) -> Floats:
    """Leaves (k, 11) on `skeleton`: position, axis, normal, length and width."""
    limit = rule.thin * float(skeleton.radius[0])
    stems = len(skeleton.birth)
    counts, keys = np.empty(stems, np.int64), np.empty(stems, np.uint32)
    numbers = (rule.density, rule.length, rule.width, math.radians(rule.angle), rule.droop)
    total = _count(skeleton.position, skeleton.radius, skeleton.starts, rule.density, limit, counts)
    leaves = np.empty((total, 11), np.float32)
    owner = np.repeat(np.arange(stems, dtype=np.int32), np.diff(skeleton.starts))
    mother = owner[np.maximum(skeleton.parent[skeleton.starts[:-1]], 0)]
    _name(mother, skeleton.birth, child_key(seed_key(seed), _FOLIAGE), keys)
    _put(skeleton.position, skeleton.starts, counts, keys, numbers, leaves)
    return leaves


@njit(**FAST)
def _name(mother: Ints, birth: Ints, root: np.uint32, keys: Keys) -> None:
    """Fill the keys of all stems: each is named by its parent's key and its place among that one's stems."""
    keys[0] = root
    for stem in range(1, len(keys)):
        keys[stem] = child_key(keys[mother[stem]], birth[stem])


@njit(**FAST)
def _count(
    position: Floats, radius: Floats, starts: Ints, density: float, limit: float, counts: NDArray[np.int64]
) -> int:
    """Fill how many leaves each stem bears; return the sum."""
    total = 0
    for stem in range(len(counts)):
        i, bare, length = starts[stem + 1] - 1, starts[stem], 0.0
        thin = density > 0.0 and radius[i] < limit
        while i > bare and radius[i] < limit:
            length += _step(position, i)[3]
            i -= 1
        counts[stem] = 1 + int(length * density) if thin else 0
        total += counts[stem]
    return total


@njit(**FAST)
def _put(
    position: Floats, starts: Ints, counts: NDArray[np.int64], keys: Keys,
    numbers: tuple[float, float, float, float, float], leaves: Floats,
) -> None:  # fmt: skip
    """Fill the leaves of all stems, from the tip of each backwards."""
    density = numbers[0]
    k = 0
    for stem in range(len(counts)):
        key, i, passed = keys[stem], starts[stem + 1] - 1, 0.0
        x, y, z, length = _step(position, i)
        turn = 2.0 * math.pi * uniform(key, _START)
        for leaf in range(counts[stem]):
            own = child_key(key, leaf)
            back = (leaf - 0.5 * uniform(own, _STEP)) / density if leaf > 0 else 0.0
            while back > passed + length and i - 1 > starts[stem]:
                passed += length
                i -= 1
                x, y, z, length = _step(position, i)
            rest = min(back - passed, length)
            leaves[k, 0] = position[i, 0] - rest * x
            leaves[k, 1] = position[i, 1] - rest * y
            leaves[k, 2] = position[i, 2] - rest * z
            _turn(leaves[k], x, y, z, numbers, turn + leaf * _TURN, leaf == 0, own)
            k += 1


@njit(**INNER)
def _step(position: Floats, i: int) -> tuple[float, float, float, float]:
    """Unit direction to node `i` from the one before, upwards when both are one, and the length in metres."""
    x = np.float64(position[i, 0]) - np.float64(position[i - 1, 0])
    y = np.float64(position[i, 1]) - np.float64(position[i - 1, 1])
    z = np.float64(position[i, 2]) - np.float64(position[i - 1, 2])
    length = math.sqrt(x * x + y * y + z * z)
    if length < 1e-9:
        return 0.0, 0.0, 1.0, length
    return x / length, y / length, z / length, length


@njit(**INNER)
def _turn(
    leaf: Floats, x: float, y: float, z: float, numbers: tuple[float, float, float, float, float],
    turn: float, last: bool, key: np.uint32,
) -> None:  # fmt: skip
    """Fill axis, normal and size of a leaf at the turn `turn` around the twig's direction x, y, z."""
    _, length, width, angle, droop = numbers
    flat = math.sqrt(x * x + y * y)
    if flat > 1e-6:  # side: level and at right angles to the twig; up: at right angles to both
        side_x, side_y = -y / flat, x / flat
    else:
        side_x, side_y = 1.0, 0.0
    up_x, up_y, up_z = -z * side_y, z * side_x, x * side_y - y * side_x
    along, out = (1.0, 0.0) if last else (math.cos(angle), math.sin(angle))
    a, b = out * math.cos(turn), out * math.sin(turn)
    leaf[3], leaf[4], leaf[5] = _unit(
        along * x + a * side_x + b * up_x, along * y + a * side_y + b * up_y, along * z + b * up_z - droop
    )
    tilt_x, tilt_y = 2.0 * uniform(key, _TILT_X) - 1.0, 2.0 * uniform(key, _TILT_Y) - 1.0
    share = leaf[3] * tilt_x + leaf[4] * tilt_y + leaf[5] * 0.7
    leaf[6], leaf[7], leaf[8] = _unit(tilt_x - share * leaf[3], tilt_y - share * leaf[4], 0.7 - share * leaf[5])
    leaf[9] = length * (0.75 + 0.5 * uniform(key, _SIZE))
    leaf[10] = leaf[9] * width


@njit(**INNER)
def _unit(x: float, y: float, z: float) -> tuple[float, float, float]:
    length = math.sqrt(x * x + y * y + z * z)
    if length < 1e-6:
        return 1.0, 0.0, 0.0
    return x / length, y / length, z / length
