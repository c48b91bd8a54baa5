"""Wood of WeberPennGen: vertices of the bases and of the tips of a block, behind those that are there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.weberpenn.shapes import flare_at, radius_at, unit_taper
from generators.weberpenn.stems import BEFORE, LONG, NOW, PARENT, THICK, X, Y, Z
from treefit.plant.compiling import INNER

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


class Wood(NamedTuple):
    """Arrays of the vertices: x, y, z and radius (4, v), parent and level (2, v)."""

    numbers: NDArray[np.float32]
    integers: NDArray[np.int32]


@njit(**INNER)
def put_bases(tree, level, wood, n, block, vertices, width):
    """Put the bases of a block's stems; return (vertices, whether there was no room for all)."""
    fitting = min(width, wood.numbers.shape[1] - n)
    flare = flare_at(tree.flare, _ZERO) if level == 0 else _ONE
    _copy_places(wood, n, block, fitting)
    radius, parent, levels = wood.numbers[3], wood.integers[0], wood.integers[1]
    for s in range(fitting):
        radius[n + s] = flare * block[THICK + s]
        parent[n + s] = vertices[PARENT + s]
        levels[n + s] = level
        vertices[NOW + s] = vertices[BEFORE + s] = n + s
    return n + fitting, fitting < width


@njit(**INNER)
def put_tips(rule, tree, level, place, wood, n, block, vertices, width):
    """Put the tips of a block, at the share `place` of its length; return (vertices, whether there was no room)."""
    fitting = min(width, wood.numbers.shape[1] - n)
    _copy_places(wood, n, block, fitting)
    radius, parent, levels = wood.numbers[3], wood.integers[0], wood.integers[1]
    flare = flare_at(tree.flare, place) if level == 0 else _ONE
    left = flare * (_ONE - unit_taper(rule.taper) * place)
    for s in range(fitting):
        radius[n + s] = left * block[THICK + s]
    if rule.taper > 1:  # not a cone
        for s in range(fitting):
            radius[n + s] = flare * radius_at(np.float32(rule.taper), place, block[THICK + s], block[LONG + s])
    for s in range(fitting):
        parent[n + s] = vertices[NOW + s]
        levels[n + s] = level
        vertices[BEFORE + s] = vertices[NOW + s]
        vertices[NOW + s] = n + s
    return n + fitting, fitting < width


@njit(**INNER)
def _copy_places(wood, n, block, count):
    """Copy the places of the tips as contiguous rows."""
    for row, source in enumerate((X, Y, Z)):
        target = wood.numbers[row, n : n + count]
        for s in range(count):
            target[s] = block[source + s]
