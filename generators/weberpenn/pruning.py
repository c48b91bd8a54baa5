"""Pruning: stems are shortened until they lie within the envelope of the crown (sec. 4.7).

The paper grows a stem again and again, each time shorter. A stem that is shorter is the same one on a smaller scale, so
here it is grown once without children, and the scale at which it fits is found from its path.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.compiling import INNER
from generators.weberpenn.shapes import envelope
from generators.weberpenn.splits import split
from generators.weberpenn.stems import BLOCK, FILL, LONG, STEM, X, Y, Z, advance

_ZERO, _HALF, _ONE, _SHORTEST = (np.float32(x) for x in (0.0, 0.5, 1.0, 1e-5))
HALVINGS = 8


@njit(**INNER)
def prune(rule, tree, level, stems, m, trial, scales):
    """Shorten the first `m` of `stems`; `trial` are other stems to try with, `scales` (m,) is written."""
    count = _copy(stems, m, trial)
    scales[:m] = _ONE
    for segment in range(1, int(rule.segments) + 1):
        step = np.float32(1.0 / rule.segments)
        for b in range((count + BLOCK - 1) // BLOCK):
            width = min(BLOCK, count - b * BLOCK)
            block = trial.numbers[b]
            advance(rule, level, segment, step, segment > 0, tree.attraction, block, trial.keys[b], width)
            _fit(tree, stems, block, trial.vertices[b], width, scales)
        if segment < int(rule.segments):
            count, _ = split(rule, level, np.int64(0), segment, trial, count)
    for s in range(m):
        block, at = stems.numbers[s // BLOCK], s % BLOCK
        kept = _ONE - np.float32(tree.prune_ratio) * (_ONE - scales[s])
        block[LONG + at] = max(block[LONG + at] * kept, _SHORTEST)
        block[FILL + at] *= kept


@njit(**INNER)
def _copy(stems, m, trial):
    for b in range((m + BLOCK - 1) // BLOCK):
        for i in range(stems.numbers.shape[1]):
            trial.numbers[b, i] = stems.numbers[b, i]
        for i in range(stems.vertices.shape[1]):
            trial.vertices[b, i] = stems.vertices[b, i]
        for i in range(BLOCK):
            trial.keys[b, i] = stems.keys[b, i]
    return m


@njit(**INNER)
def _fit(tree, stems, block, vertices, width, scales):
    """Lessen the scales of the stems whose tips are outside."""
    for s in range(width):
        stem = vertices[STEM + s]
        base, at = stems.numbers[stem // BLOCK], stem % BLOCK
        bx, by, bz = base[X + at], base[Y + at], base[Z + at]
        x, y, z = block[X + s] - bx, block[Y + s] - by, block[Z + s] - bz
        high = scales[stem]
        if _inside(tree, bx + high * x, by + high * y, bz + high * z):
            continue
        low = _ZERO
        for _ in range(HALVINGS):
            middle = _HALF * (low + high)
            if _inside(tree, bx + middle * x, by + middle * y, bz + middle * z):
                low = middle
            else:
                high = middle
        scales[stem] = low


@njit(**INNER)
def _inside(tree, x, y, z):
    height = np.float32(tree.height)
    r = (height - z) / (height * (_ONE - np.float32(tree.bare)))
    return math.sqrt(x * x + y * y) < height * np.float32(tree.prune_width) * envelope(r, tree)
