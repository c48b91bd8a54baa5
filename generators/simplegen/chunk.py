"""Many branches of SimpleGen at once: a chunk grows joint by joint, in loops that vector instructions can run."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.simplegen.directions import unit
from generators.simplegen.rules import STEM_FIELDS, SWAY
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, two

CHUNK = 256  # branches at once: their numbers stay in the nearest cache
X, Y, Z, DX, DY, DZ, LONG, THICK, ROOT, STEP_X, STEP_Y, STEP_Z, RADIUS, SPIN, FREE = (CHUNK * row for row in range(15))
"""Rows of a chunk's numbers: fields of the stems; then the last step in m, radius there, a draw; the first free row."""
STEM, JOINT, MADE, PICKED = (CHUNK * row for row in range(4))
"""Rows of a chunk's keys: of the stems, of their joints, of what is made there; and the places of those picked."""
FLOATS, KEYS = FREE + 20 * CHUNK, 4 * CHUNK
_HALF, _ZERO, _ONE = np.float32(0.5), np.float32(0.0), np.float32(1.0)


@njit(**INNER)
def copy(target, source):
    """Copy `source` (m,) to the front of `target`."""
    for i in range(len(source)):
        target[i] = source[i]


@njit(**INNER)
def load(floats, keys, stems, first, count):
    """Take the stems from `first` on into the chunk."""
    for row in range(STEM_FIELDS):
        copy(floats[CHUNK * row : CHUNK * row + count], stems.fields[row, first : first + count])
    copy(keys[STEM : STEM + count], stems.keys[first : first + count])


@njit(**INNER)
def advance(rule, floats, keys, count, i):
    """Move the tips of the chunk to joint `i`, counted from 1."""
    before = (rule.start + (1.0 - rule.start) * (i - 1) / rule.joints) if i > 1 else 0.0
    now = rule.start + (1.0 - rule.start) * i / rule.joints
    step, thin = np.float32(now - before), np.float32(1.0 - now * (1.0 - rule.taper))
    sway, rightwards = np.float32(2.0 * rule.wobble / math.sqrt(rule.joints)), np.float32(rule.rightwards) * step
    upwards = np.float32(rule.upwards) * step
    for s in range(count):
        joint = child_key(keys[STEM + s], i)
        keys[JOINT + s] = joint
        wx, wy = two(joint)
        wz, spin = two(child_key(joint, SWAY))
        dx, dy, dz = unit(
            floats[DX + s] + sway * (wx - _HALF) + rightwards, floats[DY + s] + sway * (wy - _HALF),
            floats[DZ + s] + sway * (wz - _HALF) + upwards,
        )  # fmt: skip
        long, z = floats[LONG + s] * step, floats[Z + s]
        above = max(z + dz * long, _ZERO)
        floats[DX + s], floats[DY + s], floats[DZ + s] = dx, dy, dz
        floats[STEP_X + s], floats[STEP_Y + s], floats[STEP_Z + s] = dx * long, dy * long, above - z
        floats[X + s] += dx * long
        floats[Y + s] += dy * long
        floats[Z + s] = above
        floats[RADIUS + s] = floats[THICK + s] * thin
        floats[SPIN + s] = spin


@njit(**INNER)
def put_wood(wood, n, floats, count, i, level, width):
    """Put the tips of the chunk as vertices n.. behind those of the joint before, `width` vertices back."""
    for row, source in enumerate((X, Y, Z, RADIUS)):
        copy(wood.numbers[row, n : n + count], floats[source : source + count])
    parent, levels = wood.integers[0, n : n + count], wood.integers[1, n : n + count]
    for s in range(count):
        levels[s] = level
    if i > 1:
        for s in range(count):
            parent[s] = n - width + s
    else:
        for s in range(count):
            parent[s] = np.int32(floats[ROOT + s])
