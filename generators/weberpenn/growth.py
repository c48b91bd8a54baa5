"""Growth of WeberPennGen: level by level, so that the budget cuts the finest; each level segment by segment."""

from __future__ import annotations

import threading
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numba.np.unsafe.ndarray import to_fixed_tuple
from numpy.typing import NDArray

from generators.weberpenn.children import count_children, put_stems
from generators.weberpenn.leaves import WORK, put_leaves
from generators.weberpenn.picks import ROW, pick
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
from treefit.plant.compiling import FAST, INNER, ONCE
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
        self.picks = (np.zeros(WORK, np.float32), np.zeros(ROW, np.int32), np.zeros(ROW, np.uint32))

    def room(self, vertices: int) -> tuple[tuple[NDArray[np.generic], ...], tuple[NDArray[np.generic], ...]]:
        """Return its arrays, with room for the stems of a level, those of the next and as many to try with."""
        blocks = vertices // BLOCK + 1  # a clone of the last segment has a single vertex
        if self.blocks < blocks:
            self.blocks = blocks
            self.stems = (
                np.zeros((3, blocks, FLOATS), np.float32), np.zeros((3, blocks, INTS), np.int32),
                np.zeros((3, blocks, BLOCK), np.uint32),
            )  # fmt: skip
        return self.stems, self.picks


class Picks(NamedTuple):
    """Children that are to be put: numbers, places of their stems in the block, keys."""

    work: NDArray[np.float32]
    owners: NDArray[np.int32]
    twigs: NDArray[np.uint32]


@njit(**FAST)
def grow(told, key, scratch, picks, numbers, integers, leaves):
    """Grow a plant; return (vertices, leaves, whether the budget cut it).

    `told` are the numbers of the tree's rule and of those of its levels. `numbers` (4, v) takes x, y, z, radius,
    `integers` (2, v) parent and level, `leaves` (11, k) position, axis, normal, size.
    """
    stem_numbers, stem_vertices, stem_keys = scratch
    tree = TreeRule(*_fixed(told[:_TREE], _TREE))
    wood, picks = Wood(numbers, integers), Picks(*picks)
    blocks = numbers.shape[1] // BLOCK + 1  # a scratch may have more, of which a plant must not know
    stems = Stems(stem_numbers[0, :blocks], stem_vertices[0, :blocks], stem_keys[0, :blocks])
    children = Stems(stem_numbers[1, :blocks], stem_vertices[1, :blocks], stem_keys[1, :blocks])
    trial = Stems(stem_numbers[2, :blocks], stem_vertices[2, :blocks], stem_keys[2, :blocks])
    _begin(tree, stems, key)
    none = np.int64(0)  # not a literal: each literal argument would be compiled once more
    levels, m, n, k, cut = int(tree.levels), none + 1, none, none, False
    for level in range(levels):
        start = _TREE + level * _LEVEL
        rule = LevelRule(*_fixed(told[start : start + _LEVEL], _LEVEL))
        if level > 0 and tree.prune_ratio > 0 and prune(rule, tree, level, stems, m, trial, numbers.shape[1] - n):
            return n, k, True
        leafy = level == levels - 1
        over = _certainly_over(rule, tree, level, leafy, told, stems, m, numbers.shape[1] - n, leaves.shape[1])
        if over and level > 0:  # a trunk there is in any case
            return n, k, True
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
def _certainly_over(rule, tree, level, leafy, told, stems, m, vertices, leaves):
    """Count the children of a level; return whether it and they are sure to be more than `vertices` or `leaves`.

    Only stems that neither split nor have whorls are sure to have as many children as they should.
    """
    children, own = np.int64(0), m * np.int64(rule.segments + 1)
    for b in range((m + BLOCK - 1) // BLOCK):
        block, width = stems.numbers[b], min(BLOCK, m - b * BLOCK)
        children += count_children(rule, level, leafy, block, stems.keys[b], width)
    if rule.splits > 0 or rule.whorl > 1 or (level == 0 and tree.base_splits > 0):
        children = np.int64(0)
    if leafy:
        return own > vertices or children > leaves
    below = told[_TREE + (level + 1) * _LEVEL]  # the first number of a level's rule: its segments
    return own + children * np.int64(below + 1) > vertices


@njit(**ONCE)
def _grow_level(rule, tree, level, leafy, stems, m, wood, n, picks, children, leaves, k):
    """Grow the first `m` stems of a level; return (children, vertices, leaves, whether the budget cut it)."""
    count = np.int64(0)
    for b in range((m + BLOCK - 1) // BLOCK):
        width = min(BLOCK, m - b * BLOCK)
        n, cut = put_bases(tree, level, wood, n, stems.numbers[b], stems.vertices[b], width)
        if cut:
            return count, n, k, True
    segments = int(rule.segments)
    for segment in range(1, segments + 1):
        start, end = np.float32((segment - 1) / rule.segments), np.float32(segment / rule.segments)
        parts = 1
        if level == 0 and segment == 1 and tree.flare > 0:
            for stop in FLARE_STOPS:
                parts += 1 if stop < end else 0
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
            if cut or n + (segments - segment) * m > wood.numbers.shape[1]:
                return count, n, k, True
    return count, n, k, False


@njit(**ONCE)
def _put_children(rule, tree, level, leafy, low, high, stems, b, width, picks, children, count, leaves, k):
    """Put the children of a block between two shares of its length; return (stems, leaves, whether one was cut)."""
    work, owners, twigs = picks
    s = child = np.int64(0)
    while s < width:
        picked, s, child = pick(rule, low, high, stems.numbers[b], stems.keys[b], width, s, child, work, owners, twigs)
        if leafy:
            k, cut = put_leaves(rule, tree, picked, work, twigs, leaves, k)
        else:
            count, cut = put_stems(rule, tree, level, stems, b, picked, work, owners, twigs, children, count)
        if cut:
            return count, k, True
    return count, k, False
