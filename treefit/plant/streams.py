"""Keyed random streams: a draw depends on (seed, place in the tree, purpose) alone, never on earlier draws.

So a changed parameter moves the parts that it governs and leaves every other draw as it was. Keys have 32 bits, so that
vector instructions make many at once; two places of a tree may share one now and then, which nobody can see.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

_STEP, _FIRST, _SECOND = np.uint32(0x9E3779B9), np.uint32(0x7FEB352D), np.uint32(0x846CA68B)
_15, _16, _LOW = np.uint32(15), np.uint32(16), np.uint32(0xFFFF)
_INVERSE_2_24, _INVERSE_2_16 = np.float32(1.0 / (1 << 24)), np.float32(1.0 / (1 << 16))
_HALF, _ZERO, _ONE, _TWO = np.float32(0.5), np.float32(0.0), np.float32(1.0), np.float32(2.0)
_SINE = tuple(np.float32(x) for x in (3.14158198, -5.1671413, 2.54188707, -0.55460885))  # of half a turn, to 1e-6


def seed_key(seed: int) -> np.uint32:
    """Key of a whole tree."""
    return np.uint32((seed ^ (seed >> 32)) & 0xFFFFFFFF)


@njit(nogil=True)
def child_key(key: np.uint32, part: int) -> np.uint32:
    """Key of the part number `part` below `key` (the finaliser "lowbias32")."""
    z = np.uint32(np.uint32(key) + np.uint32(_STEP * np.uint32(part + 1)))
    z = np.uint32((z ^ (z >> _16)) * _FIRST)
    z = np.uint32((z ^ (z >> _15)) * _SECOND)
    return np.uint32(z ^ (z >> _16))


@njit(nogil=True)
def uniform(key: np.uint32, purpose: int) -> np.float32:
    """Draw in [0, 1) for `purpose` at the place named by `key`."""
    return np.float32(np.int32(child_key(key, purpose) >> np.uint32(8))) * _INVERSE_2_24


@njit(nogil=True)
def two(key: np.uint32) -> tuple[np.float32, np.float32]:
    """Two draws in [0, 1), 16 bits each: the key itself, for places that need no more than these."""
    return np.float32(np.int32(key & _LOW)) * _INVERSE_2_16, np.float32(np.int32(key >> _16)) * _INVERSE_2_16


@njit(nogil=True)
def circle(turn: np.float32) -> tuple[np.float32, np.float32]:
    """Cosine and sine of `turn` whole turns, by a polynomial that vector instructions can run; exactly round."""
    t = turn - np.float32(np.int32(turn + math.copysign(_HALF, turn)))
    square = t * t
    s = t * (_SINE[0] + square * (_SINE[1] + square * (_SINE[2] + square * _SINE[3])))
    return _ONE - _TWO * s * s, _TWO * s * math.sqrt(max(_ONE - s * s, _ZERO))
