"""Power of a share: two polynomials, so that vector instructions can run it."""

from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER

_LOG = tuple(np.float32(x) for x in (1.44252727, -0.71791348, 0.45654041, -0.27596896, 0.12010026, -0.02528551))
_EXP = tuple(np.float32(x) for x in (0.69303297, 0.24136979, 0.05205482, 0.01354243))
_ONE, _LEAST, _BITS = np.float32(1.0), np.float32(-126.0), np.float32(127.0)
_EXPONENT, _MANTISSA, _OF_ONE = np.int32(23), np.int32(0x7FFFFF), np.int32(0x3F800000)


@njit(**INNER)
def power(x, exponent):
    """`x` to the power of `exponent`, float32, for `x` >= 0 and what is at most 1 in the end; relative error 1e-5."""
    bits = np.float32(x).view(np.int32)
    t = np.int32((bits & _MANTISSA) | _OF_ONE).view(np.float32) - _ONE  # x = (1 + t) 2^n
    log = t * (_LOG[0] + t * (_LOG[1] + t * (_LOG[2] + t * (_LOG[3] + t * (_LOG[4] + t * _LOG[5])))))
    y = max(exponent * (np.float32(np.int32(bits >> _EXPONENT)) - _BITS + log), _LEAST) - _LEAST
    n = np.int32(y)
    f = y - np.float32(n)
    share = _ONE + f * (_EXP[0] + f * (_EXP[1] + f * (_EXP[2] + f * _EXP[3])))
    return share * np.int32((n + np.int32(1)) << _EXPONENT).view(np.float32)
