"""Keyed random streams: a draw depends on (seed, place in the tree, purpose) alone, never on earlier draws.

So a changed parameter moves the parts that it governs and leaves every other draw as it was.
"""

from __future__ import annotations

import numpy as np
from numba import njit

_STEP = np.uint64(0x9E3779B97F4A7C15)
_FIRST = np.uint64(0xBF58476D1CE4E5B9)
_SECOND = np.uint64(0x94D049BB133111EB)
_INVERSE_2_24 = np.float32(1.0 / (1 << 24))


@njit(inline="always")
def child_key(key: np.uint64, part: int) -> np.uint64:
    """Key of the part number `part` below `key` (the finaliser of splitmix64)."""
    z = key + _STEP * np.uint64(part + 1)
    z = (z ^ (z >> np.uint64(30))) * _FIRST
    z = (z ^ (z >> np.uint64(27))) * _SECOND
    return z ^ (z >> np.uint64(31))


@njit(inline="always")
def uniform(key: np.uint64, purpose: int) -> np.float32:
    """Draw in [0, 1) for `purpose` at the place named by `key`."""
    return np.float32(child_key(key, purpose) >> np.uint64(40)) * _INVERSE_2_24


_INVERSE_2_16 = np.float32(1.0 / (1 << 16))


@njit(inline="always")
def four(key: np.uint64) -> tuple[np.float32, np.float32, np.float32, np.float32]:
    """Four draws in [0, 1), 16 bits each: the key itself, for places that need no more than these."""
    mask = np.uint64(0xFFFF)
    return (
        np.float32(key & mask) * _INVERSE_2_16,
        np.float32((key >> np.uint64(16)) & mask) * _INVERSE_2_16,
        np.float32((key >> np.uint64(32)) & mask) * _INVERSE_2_16,
        np.float32(key >> np.uint64(48)) * _INVERSE_2_16,
    )


_POINTS = 1024
_ANGLES = 2 * np.pi * np.arange(_POINTS) / _POINTS
_COS, _SIN = np.cos(_ANGLES).astype(np.float32), np.sin(_ANGLES).astype(np.float32)


@njit(inline="always")
def circle(turn: np.float32) -> tuple[np.float32, np.float32]:
    """Cosine and sine of `turn` whole turns, read from a table: far cheaper than the functions, and exact enough."""
    at = int(turn * np.float32(_POINTS)) & (_POINTS - 1)
    return _COS[at], _SIN[at]
