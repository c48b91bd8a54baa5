"""Counting in words of bit rows: a word is 64 pixels, its lowest bit the leftmost."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

ONE = np.uint64(1)
INNER: dict[str, Any] = {"nogil": True, "error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Settings of kernels that only kernels call: a third of the time to compile."""


@njit(inline="always")
def popcount(x: np.uint64) -> int:
    """Count of set bits."""
    x = x - ((x >> np.uint64(1)) & np.uint64(0x5555555555555555))
    x = (x & np.uint64(0x3333333333333333)) + ((x >> np.uint64(2)) & np.uint64(0x3333333333333333))
    x = (x + (x >> np.uint64(4))) & np.uint64(0x0F0F0F0F0F0F0F0F)
    return int((x * np.uint64(0x0101010101010101)) >> np.uint64(56))


@njit(inline="always")
def lowest_bit(x: np.uint64) -> int:
    """Place of the lowest set bit, 64 when there is none."""
    return popcount((x & (~x + ONE)) - ONE)


@njit(inline="always")
def highest_bit(x: np.uint64) -> int:
    """Place of the highest set bit, -1 when there is none."""
    for shift in (1, 2, 4, 8, 16, 32):
        x |= x >> np.uint64(shift)
    return popcount(x) - 1
