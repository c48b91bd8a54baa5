"""Rasteriser of plants into bit rows: one bit a pixel, one plane a class and depth slab, primitives OR-ed in."""

from __future__ import annotations

import threading

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant.compiling import FAST
from treefit.plant.extent import depth_of, height_of
from treefit.view import branches, leaves, stamps
from treefit.view.branches import draw_branches
from treefit.view.composite import composite
from treefit.view.leaves import draw_leaves

_TINY = np.float32(1e-6)


class Scratch(threading.local):
    """Memory of the kernels, one of each thread, kept from view to view."""

    def __init__(self) -> None:
        self.bits = np.empty(1, np.uint64)
        self.seen = np.empty(1, np.float32)
        self.floats = np.empty(max(branches.FLOATS, leaves.FLOATS), np.float32)
        self.integers = np.empty(stamps.INTEGERS, np.int32)
        self.masks = np.empty(stamps.MASKS, np.uint32)

    def room(self, words: int, vertices: int) -> tuple[NDArray[np.generic], ...]:
        """Return its arrays, `bits` of `words` words and one that spans touch behind them, `seen` for `vertices`."""
        if len(self.bits) <= words:
            self.bits = np.empty(words + 1, np.uint64)
        if len(self.seen) < 3 * vertices:
            self.seen = np.empty(6 * vertices, np.float32)
        return self.bits, self.seen, self.floats, self.integers, self.masks


@njit(**FAST)
def draw(scratch, slabs, directions, behind, wood, foliage, planes):
    """Draw a plant from each of `directions` (m, 2), cosine and sine of its turn, into `planes` (k, 2, height, words).

    `wood` is position, radius, parent, level, `foliage` position, axis, normal, size. With `behind` k = 2 m: the last m
    planes are the sides opposite to the first, which have the same pixels mirrored and the other order of slabs.
    """
    bits, seen, floats, integers, masks = scratch
    xyz, radius, parent, level = wood
    position, axis, normal, size = foliage
    _, _, height, words = planes.shape
    top = height_of(xyz[2], position[2], axis, normal, size)
    scale = np.float32(height) / top
    for i in range(len(directions)):
        cos, sin = directions[i]
        near, far = depth_of(xyz[0], xyz[1], cos, sin)
        per_depth = np.float32(slabs) / (far - near + _TINY)
        bits[: slabs * 2 * height * words + 1] = 0
        draw_branches(
            bits, slabs, height, words, xyz, radius, parent, level, cos, sin, scale, near, per_depth,
            seen, floats, integers, masks,
        )  # fmt: skip
        draw_leaves(
            bits, slabs, height, words, position, axis, normal, size, cos, sin, scale, near, per_depth,
            floats, integers, masks,
        )  # fmt: skip
        for turned in range(2 if behind else 1):
            plane = planes[i + turned * len(directions)]
            composite(bits, slabs, plane[0], plane[1], turned)
