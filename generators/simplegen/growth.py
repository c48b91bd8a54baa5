"""Growth of SimpleGen: trunk, branches level by level, twigs with their leaves; so the budget cuts the finest."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
from numba import njit
from numba.np.unsafe.ndarray import to_fixed_tuple
from numpy.typing import NDArray

from generators.simplegen.branches import grow_branches
from generators.simplegen.chunk import FLOATS, KEYS
from generators.simplegen.crown import NUMBERS
from generators.simplegen.rules import STEM_FIELDS, LeafRule, LevelRule, Stems, Wood
from generators.simplegen.trunk import grow_trunk
from generators.simplegen.twigs import grow_twigs
from treefit.plant.compiling import FAST, ONCE

_fixed: Any = to_fixed_tuple  # an intrinsic: its first argument is the compiler's
_LEVEL, _LEAF = len(LevelRule._fields), len(LeafRule._fields)


class Scratch(threading.local):
    """Memory of the kernels, one of each thread, kept from plant to plant."""

    def __init__(self) -> None:
        self.stems = np.empty((2, STEM_FIELDS, 0), np.float32)
        self.stem_keys = np.empty((2, 0), np.uint32)
        self.floats, self.keys = np.zeros(FLOATS, np.float32), np.zeros(KEYS, np.uint32)

    def room(self, stems: int) -> tuple[NDArray[np.generic], ...]:
        """Return its arrays, with room for `stems` branches of a level and those of the one before."""
        if self.stem_keys.shape[1] < stems:
            self.stems, self.stem_keys = np.empty((2, STEM_FIELDS, stems), np.float32), np.empty((2, stems), np.uint32)
        return self.stems, self.stem_keys, self.floats, self.keys


@njit(**FAST)
def grow(told, crown_numbers, levels, length, radius, lean, key, scratch, numbers, integers, leaves):
    """Grow a plant; return (vertices, leaves, whether the budget cut it).

    `told` are the numbers of the rules of all levels and of the leaves, `crown_numbers` those of the crown. `numbers`
    (4, v) takes x, y, z, radius, `integers` (2, v) parent and level, `leaves` (11, k) position, axis, normal, size.
    """
    stems, stem_keys, floats, keys = scratch
    wood = Wood(numbers, integers)
    front, back = Stems(stems[0], stem_keys[0]), Stems(stems[1], stem_keys[1])
    crown = _fixed(crown_numbers, NUMBERS)
    leaf_rule = LeafRule(*_fixed(told[levels * _LEVEL : levels * _LEVEL + _LEAF], _LEAF))
    n, m, cut = grow_trunk(_rule(told, 0), crown, length, length * radius, lean, key, wood, front)
    for level in range(1, levels - 1):
        if cut:
            return n, 0, True
        n, m, cut = grow_branches(_rule(told, level), crown, level, front, m, wood, n, back, floats, keys)
        front, back = back, front
    if cut:
        return n, 0, True
    return grow_twigs(_rule(told, levels - 1), levels - 1, leaf_rule, front, m, wood, n, leaves, floats, keys)


@njit(**ONCE)
def _rule(told, level):
    return LevelRule(*_fixed(told[level * _LEVEL : (level + 1) * _LEVEL], _LEVEL))
