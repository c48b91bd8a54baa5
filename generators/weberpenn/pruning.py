"""Pruning: stems are shortened until they lie within the envelope of the crown (sec. 4.7).

The paper grows a stem again and again, each time shorter. A stem that is shorter is the same one on a smaller scale, so
here it is grown once without children, and the scale at which it fits is found from its path.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.weberpenn.shapes import envelope
from generators.weberpenn.splits import split
from generators.weberpenn.stems import BEGIN, BLOCK, FILL, LONG, MADE, STEM, THICK, TURN, X, Y, Z, advance
from treefit.plant.compiling import INNER, ONCE

_ZERO, _HALF, _ONE, _SHORTEST = (np.float32(x) for x in (0.0, 0.5, 1.0, 1e-5))
HALVINGS = 8
BASE_X, BASE_Y, BASE_Z, SCALE, LOW = THICK, BEGIN, FILL, TURN, MADE
"""Rows of a stem that is only tried: where it begins, scale at which it fits so far, and one that does."""


@njit(**ONCE)
def prune(rule, tree, level, stems, m, trial, room):
    """Shorten the first `m` of `stems`; return whether they and their clones have more than `room` vertices.

    `trial` are other stems to try with. When there are too many it ends at once.
    """
    _copy(stems, m, trial)
    count, vertices, segments = m, m, int(rule.segments)
    step = np.float32(1.0 / rule.segments)
    for segment in range(1, segments + 1):
        vertices += count
        if vertices + (segments - segment) * count > room:
            return True
        for b in range((count + BLOCK - 1) // BLOCK):
            block, width = trial.numbers[b], min(BLOCK, count - b * BLOCK)
            advance(rule, level, segment, step, segment > 0, tree.attraction, block, trial.keys[b], width)
            _fit(tree, block, width)
        if segment < segments:
            count, cut = split(rule, level, np.int64(0), segment, trial, count)
            if cut:
                return True
    for s in range(m, count):  # clones have the scale of their stem
        stem, scale = trial.vertices[s // BLOCK, STEM + s % BLOCK], trial.numbers[s // BLOCK, SCALE + s % BLOCK]
        block, at = trial.numbers[stem // BLOCK], SCALE + stem % BLOCK
        block[at] = min(block[at], scale)
    for s in range(m):
        block, at = stems.numbers[s // BLOCK], s % BLOCK
        kept = _ONE - np.float32(tree.prune_ratio) * (_ONE - trial.numbers[s // BLOCK, SCALE + at])
        block[LONG + at] = max(block[LONG + at] * kept, _SHORTEST)
        block[FILL + at] *= kept
    return False


@njit(**INNER)
def _copy(stems, m, trial):
    for b in range((m + BLOCK - 1) // BLOCK):
        block = trial.numbers[b]
        for i in range(len(block)):
            block[i] = stems.numbers[b, i]
        for s in range(BLOCK):
            trial.vertices[b, STEM + s] = stems.vertices[b, STEM + s]
            trial.keys[b, s] = stems.keys[b, s]
            block[BASE_X + s], block[BASE_Y + s], block[BASE_Z + s] = block[X + s], block[Y + s], block[Z + s]
            block[SCALE + s] = _ONE


@njit(**INNER)
def _fit(tree, block, width):
    """Lessen the scales of the stems whose tips are outside, by halving."""
    for s in range(width):
        block[LOW + s] = _ZERO
    for halving in range(HALVINGS + 1):
        share, outside = _HALF if halving > 0 else _ONE, 0
        for s in range(width):
            x, y, z = block[BASE_X + s], block[BASE_Y + s], block[BASE_Z + s]
            low, high = block[LOW + s], block[SCALE + s]
            middle = low + share * (high - low)
            fits = _inside(
                tree, x + middle * (block[X + s] - x), y + middle * (block[Y + s] - y), z + middle * (block[Z + s] - z)
            )
            block[LOW + s], block[SCALE + s] = middle if fits else low, high if fits else middle
            outside += not fits
        if halving == 0 and outside == 0:
            return
    for s in range(width):
        block[SCALE + s] = block[LOW + s]


@njit(**INNER)
def _inside(tree, x, y, z):
    height = np.float32(tree.height)
    r = (height - z) / (height * (_ONE - np.float32(tree.bare)))
    return math.sqrt(x * x + y * y) < height * np.float32(tree.prune_width) * envelope(r, tree)
