"""Collars: where a stem leaves its parent's surface, and which stems are thick enough to be shaped there."""

from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.bends import point
from treefit.plant.compiling import INNER
from treefit.plant.rings import apart, put

THICK = 1 / 2400  # radius in plant sizes from which a stem has a collar
FULL = 1 / 500  # from which it is round along the stem too, one ring more
FLAT = 0.42  # sine of the angle to the parent under which a stem runs along it and needs none
SWELL = 1.25  # of a collar along the parent, in radii
RUN = 0.7  # by which it runs out along the parent under a stem that leaves it at an acute angle, in radii
ROOM = 0.92  # of the parent's radius that a stem has at most
SLANT = 0.5  # of the neck, the end of a collar, as a share of that on the parent's surface


@njit(**INNER)
def reaches(radius, host_radius, cosine):
    """Lengths along a stem from its parent's axis to the surface, to the neck and to the first ring beyond.

    Where two cylinders meet at an angle the rim of the narrow one is slanted by the cotangent of it.
    """
    sine = np.sqrt(max(1 - cosine * cosine, FLAT * FLAT))
    surface, slant = host_radius / sine, SWELL * radius * abs(cosine) / sine
    neck = surface + 0.6 * radius + 0.6 * slant
    return surface, neck, neck + SLANT * slant + 0.25 * radius


@njit(**INNER)
def fits(radius, host_radius, cosine, below, above):
    """Whether a stem can have a collar on a parent that reaches `below` and `above` (m) its seat."""
    if 1 - cosine * cosine < FLAT * FLAT or radius > ROOM * host_radius:
        return False
    sine = np.sqrt(1 - cosine * cosine)
    middle, half = host_radius * cosine / sine, SWELL * radius / sine
    run = RUN * radius * abs(cosine) / sine
    low, high = middle - half - (run if cosine > 0 else 0.0), middle + half + (run if cosine < 0 else 0.0)
    return low > -below and high < above


@njit(**INNER)
def put_collar(rings, n, old, radius, low, last, bend, guide, wood, fewest, place):
    """Put the collar of the stem with rings low .. low + last, if it can have one.

    `guide` (3,) is the direction of its parent, `wood` the parent's radius and how far it reaches below and above the
    seat. Returns the next ring, and segment and share of it where the stem
    goes on. The rings that lie before that give way to as many on the collar.
    """
    begin, r, host_radius = n, radius[low], wood[0]
    cosine = bend.unit[0, 0] * guide[0] + bend.unit[0, 1] * guide[1] + bend.unit[0, 2] * guide[2]
    _, neck, _ = reaches(r, host_radius, cosine)
    k, t = _locate(bend.length, last, neck)
    point(old, radius, low + k, k, bend, t, place)
    far = max(apart(place, old[low]), 1e-12)
    cosine = 0.0
    for axis in range(3):
        cosine += (place[axis] - old[low, axis]) / far * guide[axis]
    surface, neck, end = reaches(r, host_radius, cosine)
    beyond, _ = _locate(bend.length, last, end)
    if beyond >= last or not fits(r, host_radius, cosine, wood[1], wood[2]):
        return n, 0, 0.0
    n = put(rings, n, begin, old, radius, low, 0, 0.0, bend, 0.0)
    count = max(fewest, beyond)
    for i in range(1, count + 1):
        k, t = _locate(bend.length, last, surface + (neck - surface) * i / count)
        n = put(rings, n, begin, old, radius, low, k, t, bend, i / count)
    k, t = _locate(bend.length, last, end)
    return n, k, t


@njit(**INNER)
def _locate(length, last, far):
    """Segment and share of it that are `far` m from where a stem begins; (last, 0) beyond its end."""
    for k in range(last):
        if far < length[k]:
            return k, far / length[k]
        far -= length[k]
    return last, 0.0
