"""Bark uv: where on its picture, one metre wide and high, the bark of a stem lies."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.asset.mesh.stems import Stems

FINEST = 12.0  # times that the picture is made smaller at most
_TAPER = 4.0  # times that it is made smaller at most where a stem is thinner than its mean

Floats = NDArray[np.float64]


def bark_uv(stems: Stems) -> tuple[Floats, Floats]:
    """Pictures around each stem (s,), and place of each ring (r,) along the picture.

    A whole number of pictures goes around a stem, that nearest to its mean girth in metres, so there is no seam; along
    the stem the picture is made larger or smaller as it is around it, so nothing is stretched. Stems of less than
    1 / FINEST m have a part of a picture around them, and a seam that nobody sees. A stem begins where its parent is.
    """
    girth = 2 * np.pi * stems.radius
    mean = _mean_along(stems, girth)
    around = np.where(mean * FINEST >= 1, np.maximum(np.round(mean), 1), mean * FINEST)
    scale = around[stems.stem] / np.maximum(girth, mean[stems.stem] / _TAPER)
    return around, _running(stems.first, stems.along, stems.host, stems.share, scale)


def _mean_along(stems: Stems, values: Floats) -> Floats:
    """Mean (s,) over the length of each stem of values at its rings (r,)."""
    step = np.append(np.diff(stems.along), 0.0)
    step[stems.first[1:] - 1] = 0.0
    between = step * (values + np.append(values[1:], 0.0)) / 2
    length = stems.along[stems.first[1:] - 1]
    return np.asarray(np.add.reduceat(between, stems.first[:-1]) / length)


@njit(cache=True, nogil=True)
def _running(first, along, host, share, scale):
    """Sum (r,) of scale over length along each stem, from that of its parent on."""
    total = np.zeros(along.shape[0])
    for s in range(first.shape[0] - 1):
        j = host[s]
        if j >= 0:
            total[first[s]] = total[j] + (share[s] * (total[j + 1] - total[j]) if share[s] > 0 else 0.0)
        for i in range(first[s] + 1, first[s + 1]):
            total[i] = total[i - 1] + (along[i] - along[i - 1]) * (scale[i] + scale[i - 1]) / 2
    return total
