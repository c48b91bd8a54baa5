"""Leaves of SimpleGen: at the joints of the last level, for a chunk of its branches at once."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.simplegen.chunk import CHUNK, FREE, JOINT, MADE, PICKED, SPIN, STEP_X, STEP_Y, STEP_Z, X, Y, Z, copy
from generators.simplegen.directions import frame, unit
from generators.simplegen.rules import LEAF
from treefit.plant.compiling import INNER, ONCE
from treefit.plant.streams import child_key, circle, two

STEP, PLACE, AXIS, NORMAL, SIZE, TURN = (FREE + CHUNK * row for row in (0, 3, 6, 9, 12, 14))  # PLACE.. as in a plant
_HALF, _SMALLEST, _SPREAD = np.float32(0.5), np.float32(0.7), np.float32(0.6)  # sizes are in 0.7 .. 1.3 of the mean
_10, _11, _22 = np.uint32(10), np.uint32(11), np.uint32(22)
_LOW_10, _LOW_11 = np.uint32((1 << 10) - 1), np.uint32((1 << 11) - 1)
_INVERSE_10, _INVERSE_11 = np.float32(1.0 / (1 << 10)), np.float32(1.0 / (1 << 11))


@njit(**ONCE)
def put_leaves(rule, floats, keys, count, leaves, k):
    """Put the leaves of one joint of the chunk behind the first `k`; return (leaves, whether the budget cut them)."""
    cosine, sine = np.float32(math.cos(rule.angle)), np.float32(math.sin(rule.angle))
    length, width, share = np.float32(rule.length), np.float32(rule.width), np.float32(1.0 / rule.number)
    threshold, room = np.float32(rule.probability), leaves.shape[1]
    for j in range(int(rule.number)):
        picked = _pick(keys, count, j, threshold)
        fitting = min(picked, room - k)
        _gather(floats, keys, fitting, np.float32(j) * share, share)
        _shape(floats, keys, fitting, cosine, sine, length, width)
        _store(leaves, k, floats, fitting)
        k += fitting
        if fitting < picked:
            return k, True
    return k, False


@njit(**INNER)
def _pick(keys, count, j, probability):
    """Make the keys of the leaves number `j`; list those that are there and return their count."""
    for s in range(count):
        keys[MADE + s] = child_key(keys[JOINT + s], LEAF + j)
    picked = 0
    for s in range(count):
        kept, _ = two(keys[MADE + s])
        keys[PICKED + picked] = s
        picked += kept < probability
    return picked


@njit(**INNER)
def _gather(floats, keys, count, turn, share):
    """Joint, step to it and turn around it of each leaf that was picked; their keys to the front of MADE."""
    for k in range(count):
        s = keys[PICKED + k]
        floats[PLACE + k], floats[PLACE + CHUNK + k] = floats[X + s], floats[Y + s]
        floats[PLACE + 2 * CHUNK + k] = floats[Z + s]
        floats[STEP + k], floats[STEP + CHUNK + k] = floats[STEP_X + s], floats[STEP_Y + s]
        floats[STEP + 2 * CHUNK + k] = floats[STEP_Z + s]
        _, vary = two(keys[MADE + s])
        floats[TURN + k] = floats[SPIN + s] + turn + _HALF * share * vary
        keys[MADE + k] = keys[MADE + s]


@njit(**INNER)
def _shape(floats, keys, count, cosine, sine, length, width):
    """Attachment, axis, normal and size of the leaves."""
    for k in range(count):
        sx, sy, sz = floats[STEP + k], floats[STEP + CHUNK + k], floats[STEP + 2 * CHUNK + k]
        draw = child_key(keys[MADE + k], 0)
        back = np.float32(np.int32(draw & _LOW_11)) * _INVERSE_11
        roll = np.float32(np.int32((draw >> _11) & _LOW_11)) * _INVERSE_11
        scale = _SMALLEST + _SPREAD * (np.float32(np.int32(draw >> _22)) * _INVERSE_10)
        dx, dy, dz = unit(sx, sy, sz)
        ux, uy, uz, wx, wy, wz = frame(dx, dy, dz)
        c, s = circle(floats[TURN + k])
        ox, oy, oz = c * ux + s * wx, c * uy + s * wy, c * uz + s * wz  # outwards from the branch
        tx, ty, tz = c * wx - s * ux, c * wy - s * uy, c * wz - s * uz  # around it
        c, s = circle(roll)
        nx = c * tx + s * (cosine * ox - sine * dx)
        ny = c * ty + s * (cosine * oy - sine * dy)
        nz = c * tz + s * (cosine * oz - sine * dz)
        up = math.copysign(np.float32(1.0), nz)  # the upper side to the sky
        floats[PLACE + k] -= back * sx
        floats[PLACE + CHUNK + k] -= back * sy
        floats[PLACE + 2 * CHUNK + k] -= back * sz
        floats[AXIS + k], floats[AXIS + CHUNK + k] = cosine * dx + sine * ox, cosine * dy + sine * oy
        floats[AXIS + 2 * CHUNK + k] = cosine * dz + sine * oz
        floats[NORMAL + k], floats[NORMAL + CHUNK + k], floats[NORMAL + 2 * CHUNK + k] = up * nx, up * ny, up * nz
        floats[SIZE + k], floats[SIZE + CHUNK + k] = length * scale, width * scale


@njit(**INNER)
def _store(leaves, k, floats, count):
    for row in range(len(leaves)):
        at = PLACE + CHUNK * row
        copy(leaves[row, k : k + count], floats[at : at + count])
