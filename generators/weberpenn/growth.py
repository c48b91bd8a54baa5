"""Growth of WeberPennGen: level by level, so that the budget cuts the finest; each level segment by segment."""

from __future__ import annotations

import threading
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numba.np.unsafe.ndarray import to_fixed_tuple
from numpy.typing import NDArray

from generators.compiling import FAST, INNER, ONCE
from generators.weberpenn.children import count_children, pick, put_stems
from generators.weberpenn.leaves import WORK, put_leaves
from generators.weberpenn.pruning import prune
from generators.weberpenn.rules import LevelRule, TreeRule
from generators.weberpenn.splits import split
from generators.weberpenn.stems import (
    BACK,
    BEFORE,
    BEGIN,
    BLOCK,
    DUE,
    FILL,
    FLOATS,
    INTS,
    LONG,
    NOW,
    PARENT,
    STEM,
    THICK,
    TURN,
    Stems,
    X,
    Y,
    Z,
    advance,
    put_frame,
)  # fmt: skip
from generators.weberpenn.wood import Wood, put_bases, put_tips
from treefit.plant.streams import child_key, two

FLARE_STOPS = tuple(np.float32(x) for x in (1 / 64, 1 / 32, 1 / 16, 1 / 8))
"""Shares of the trunk at which its first segment gets vertices of its own, so that its flare can be seen."""

_fixed: Any = to_fixed_tuple  # an intrinsic: its first argument is the compiler's
_LEVEL, _TREE = len(LevelRule._fields), len(TreeRule._fields)
_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


class Scratch(threading.local):
    """Memory of the kernels, one of each thread, kept from plant to plant."""

    def __init__(self) -> None:
        self.stems: tuple[NDArray[np.generic], ...] = ()
        self.blocks = 0
        self.picks = (np.zeros(WORK, np.float32), np.zeros(BLOCK, np.int32), np.zeros(BLOCK, np.uint32))

    def room(self, stems: int) -> tuple[tuple[NDArray[np.generic], ...], tuple[NDArray[np.generic], ...]]:
        """Return its arrays, with room for `stems` stems of a level, those of the next and as many to try with."""
        blocks = (stems + BLOCK - 1) // BLOCK
        if self.blocks < blocks:
            self.blocks = blocks
            self.stems = (
                np.zeros((3, blocks, FLOATS), np.float32), np.zeros((3, blocks, INTS), np.int32),
                np.zeros((3, blocks, BLOCK), np.uint32), np.zeros(blocks * BLOCK, np.float32),
            )  # fmt: skip
        return self.stems, self.picks


class Picks(NamedTuple):
    """Children that are to be put: numbers, places of their stems in the block, keys."""

    work: NDArray[np.float32]
    owners: NDArray[np.int32]
    keys: NDArray[np.uint32]


@njit(**FAST)
def grow(told, key, scratch, picks, numbers, integers, leaves):
    """Grow a plant; return (vertices, leaves, whether the budget cut it).

    `told` are the numbers of the tree's rule and of those of its levels. `numbers` (4, v) takes x, y, z, radius,
    `integers` (2, v) parent and level, `leaves` (11, k) position, axis, normal, size.
    """
    stem_numbers, stem_vertices, stem_keys, scales = scratch
    tree = TreeRule(*_fixed(told[:_TREE], _TREE))
    wood, picks = Wood(numbers, integers), Picks(*picks)
    blocks = (numbers.shape[1] + BLOCK - 1) // BLOCK  # of this budget: there may be more, from a plant before
    stems = Stems(stem_numbers[0, :blocks], stem_vertices[0, :blocks], stem_keys[0, :blocks])
    children = Stems(stem_numbers[1, :blocks], stem_vertices[1, :blocks], stem_keys[1, :blocks])
    trial = Stems(stem_numbers[2, :blocks], stem_vertices[2, :blocks], stem_keys[2, :blocks])
    _begin(tree, stems, key)
    none = np.int64(0)  # not a literal: each literal argument would be compiled once more
    levels, m, n, k, cut = int(tree.levels), none + 1, none, none, False
    for level in range(levels):
        start = _TREE + level * _LEVEL
        rule = LevelRule(*_fixed(told[start : start + _LEVEL], _LEVEL))
        if level > 0 and tree.prune_ratio > 0:
            prune(rule, tree, level, stems, m, trial, scales)
        leafy = level == levels - 1
        m, n, k, cut = _grow_level(rule, tree, level, leafy, stems, m, wood, n, picks, children, leaves, k)
        if cut or m == 0:
            break
        stems, children = children, stems
    return n, k, cut


@njit(**INNER)
def _begin(tree, stems, key):
    """Make the trunk: upright, its bends to the right of the picture and to the left."""
    block = stems.numbers[0]
    block[X] = block[Y] = block[Z] = block[BACK] = block[BEGIN] = _ZERO
    put_frame(block, 0, _ZERO, _ZERO, _ONE, _ZERO, _ONE, _ZERO)
    block[LONG], block[THICK], block[FILL] = np.float32(tree.length), np.float32(tree.radius), _ONE
    block[DUE], block[TURN] = two(child_key(key, 0))
    for row in (NOW, BEFORE, STEM):
        stems.vertices[0, row] = 0
    stems.vertices[0, PARENT] = -1
    stems.keys[0, 0] = child_key(key, 1)


@njit(**ONCE)
def _grow_level(rule, tree, level, leafy, stems, m, wood, n, picks, children, leaves, k):
    """Grow the first `m` stems of a level; return (children, vertices, leaves, whether the budget cut it)."""
    count = np.int64(0)
    for b in range((m + BLOCK - 1) // BLOCK):
        width = min(BLOCK, m - b * BLOCK)
        count_children(rule, level, leafy, stems.numbers[b], stems.keys[b], width)
        n, cut = put_bases(tree, level, wood, n, stems.numbers[b], stems.vertices[b], width)
        if cut:
            return count, n, k, True
    segments = int(rule.segments)
    for segment in range(1, segments + 1):
        start, end = np.float32((segment - 1) / rule.segments), np.float32(segment / rule.segments)
        parts = 1
        if level == 0 and segment == 1 and tree.flare > 0:
            for stop in FLARE_STOPS:
                parts += stop < end
        low = start
        for part in range(parts):
            high = FLARE_STOPS[part] if part < parts - 1 else end
            for b in range((m + BLOCK - 1) // BLOCK):
                width = min(BLOCK, m - b * BLOCK)
                block, vertices, keys = stems.numbers[b], stems.vertices[b], stems.keys[b]
                advance(rule, level, segment, high - low, part == 0, tree.attraction, block, keys, width)
                n, cut = put_tips(rule, tree, level, high, wood, n, block, vertices, width)
                if cut:
                    return count, n, k, True
                count, k, cut = _put_children(
                    rule, tree, level, leafy, low, high, stems, b, width, picks, children, count, leaves, k
                )
                if cut:
                    return count, n, k, True
            low = high
        if segment < segments:
            m, cut = split(rule, level, int(tree.base_splits), segment, stems, m)
            if cut:
                return count, n, k, True
    return count, n, k, False


@njit(**ONCE)
def _put_children(rule, tree, level, leafy, low, high, stems, b, width, picks, children, count, leaves, k):
    """Put the children of a block between two shares of its length; return (stems, leaves, whether one was cut)."""
    block, picked, last, cut = stems.numbers[b], np.int64(0), high >= _ONE, False
    work, owners, keys = picks
    for s in range(width):
        child = np.int64(0)
        while True:
            picked, child = pick(rule, stems.keys[b, s], low, high, last, block, s, child, work, owners, keys, picked)
            if child > 0 or s == width - 1:
                if leafy:
                    k, cut = put_leaves(rule, tree, high, block, picked, work, owners, keys, leaves, k)
                else:
                    count, cut = put_stems(
                        rule, tree, level, high, stems, b, picked, work, owners, keys, children, count
                    )
                picked = np.int64(0)
            if cut:
                return count, k, True
            if child == 0:
                break
    return count, k, False
