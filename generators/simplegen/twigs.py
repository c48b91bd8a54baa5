"""Growth of SimpleGen's last level with its leaves, joint by joint."""

from __future__ import annotations

import numpy as np
from numba import njit

from generators.simplegen.chunk import CHUNK, advance, load, put_wood
from generators.simplegen.leaves import put_leaves
from treefit.plant.compiling import ONCE


@njit(**ONCE)
def grow_twigs(rule, level, leaf_rule, stems, n_stems, wood, n, leaves, floats, keys):
    """Grow the first `n_stems` of `stems` into `wood` from vertex n on, and their leaves.

    Return (vertices, leaves, whether the budget cut it).
    """
    k = np.int64(0)  # not a literal: each literal argument would be compiled once more
    for first in range(0, n_stems, CHUNK):
        count = min(CHUNK, n_stems - first)
        load(floats, keys, stems, first, count)
        for i in range(1, int(rule.joints) + 1):
            advance(rule, floats, keys, count, i)
            fitting = min(count, wood.numbers.shape[1] - n)
            put_wood(wood, n, floats, fitting, i, level, count)
            n += fitting
            if fitting < count:
                return n, k, True
            k, cut = put_leaves(leaf_rule, floats, keys, count, leaves, k)
            if cut:
                return n, k, True
    return n, k, False
