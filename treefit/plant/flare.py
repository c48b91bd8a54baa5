"""Flare: the foot of a trunk, wider at the ground and a little in it."""

from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.compiling import INNER
from treefit.plant.rings import NO_COLLAR, put

WIDENING = 0.42  # of the radius at the ground that a trunk has in all
LEAST = 0.08  # that is added even where the radii of the plant widen by themselves
SPAN = 3.0  # height in radii on which they may do so
FADE = 1.0  # height in radii at which a third of it is left
RINGS = (0.4, 1.0, 2.0)  # heights in radii at which the foot gets rings
STEEPEST = 0.8  # slope of the foot under the ground, which goes on as above
DEPTH = 0.35  # in radii, of the lowest ring under the ground


@njit(**INNER)
def put_foot(rings, n, old, radius, low, bend):
    """Put the rings of the foot, the lowest one under the ground; return the next ring and the share it ends at."""
    begin, t = n, 0.0
    n = put(rings, n, begin, old, radius, low, 0, 0.0, bend, NO_COLLAR)
    rings.centre[begin, 2] -= DEPTH * radius[low]
    n = put(rings, n, begin, old, radius, low, 0, 0.0, bend, NO_COLLAR)
    for height in RINGS:
        share = height * radius[low] / bend.length[0]
        if share < 0.8:
            t = share
            n = put(rings, n, begin, old, radius, low, 0, t, bend, NO_COLLAR)
    return n, t


@njit(**INNER)
def widen(rings, end, radius, low, last, bend):
    """Widen the trunk, rings 0 .. end - 1, at the ground by what it does not widen by on its lowest radii."""
    foot = radius[low]
    ground = DEPTH * foot
    above, reach = radius[low + last], 0.0
    for k in range(last):
        if reach + bend.length[k] > SPAN * foot:
            t = (SPAN * foot - reach) / bend.length[k]
            above = radius[low + k] + t * (radius[low + k + 1] - radius[low + k])
            break
        reach += bend.length[k]
    more = min(max(WIDENING - (foot / max(above, 1e-9) - 1), LEAST), WIDENING)
    for j in range(end):
        rings.radius[j] *= 1 + more * np.exp(-max(rings.along[j] - ground, 0.0) / (FADE * foot))
    steep = (rings.radius[1] - rings.radius[2]) / (rings.along[2] - ground)
    rings.radius[0] = rings.radius[1] + min(max(steep, 0.0), STEEPEST) * ground
