"""Growth of SimpleGen's branches: level by level, so that parents come first and the budget cuts the finest."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from generators.simplegen.directions import frame, unit
from treefit.plant.streams import child_key, circle, four

CHILD = 16  # first number of a joint's children
STEM_FIELDS = 9  # position x y z, direction x y z, length, radius, parent vertex
_HALF, _ZERO, _ONE, _TINY = np.float32(0.5), np.float32(0.0), np.float32(1.0), np.float32(1e-6)


class Crown(NamedTuple):
    """Envelope: length of the branches over the height of the crown, by the longest; change of their angle, rad."""

    bottom: float
    peak: float
    top: float
    power_low: float
    power_high: float
    angle_change: float
    asymmetry: float


class LevelRule(NamedTuple):
    """How the branches of one level grow and where their children begin; angles in rad, shares in [0, 1]."""

    level: int
    last: bool  # no children but leaves
    joints: int  # of the branching part; each carries children
    bare_joints: int  # of the bare part
    start: float  # bare share
    whorl: int  # children at each joint
    angle: float  # of the children
    length: float  # of the children, by that of their parent
    radius: float  # of the children, by that of their parent there
    taper: float
    upwards: float  # turn from base to tip
    rightwards: float  # the same
    wobble: float
    variation: float  # of the children's length
    shortening: float  # of the children towards the tip
    shortest: float  # m; children shorter than this do not grow


class Wood(NamedTuple):
    """Arrays of the vertices, as those of a Plant; `xyz` is (3, v)."""

    xyz: NDArray[np.float32]
    radius: NDArray[np.float32]
    parent: NDArray[np.int32]
    level: NDArray[np.int32]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def envelope(h: float, crown: Crown) -> float:
    """Length of a branch at the height h in [0, 1] of the crown, by the longest."""
    if h < crown.peak:
        return crown.bottom + (1.0 - crown.bottom) * (h / crown.peak) ** crown.power_low
    if crown.peak >= 1.0:
        return 1.0
    return crown.top + (1.0 - crown.top) * ((1.0 - h) / (1.0 - crown.peak)) ** crown.power_high


@njit(inline="always", error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _child(dx, dy, dz, cosine, sine, turn, sum_x, sum_y):
    """Direction at an angle from (dx, dy, dz), `turn` turns around it, pushed away from the sum of earlier ones."""
    ux, uy, uz, wx, wy, wz = frame(dx, dy, dz)
    p, q = circle(turn)
    x = cosine * dx + sine * (p * ux + q * wx)
    y = cosine * dy + sine * (p * uy + q * wy)
    z = cosine * dz + sine * (p * uz + q * wz)
    side = math.sqrt(x * x + y * y)
    push = _HALF * side / (math.sqrt(sum_x * sum_x + sum_y * sum_y) + _HALF)
    x -= push * sum_x
    y -= push * sum_y
    stretch = side / (math.sqrt(x * x + y * y) + _TINY)  # as far to the side as before
    return unit(x * stretch, y * stretch, z)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def grow_level(rule, crown, stems, keys, n_stems, wood, n, next_stems, next_keys):
    """Grow the first `n_stems` of `stems` (STEM_FIELDS, m) into `wood` from vertex n on.

    Children are put into `next_stems`, `next_keys`. Return (vertices, children, whether the budget cut it).
    """
    xyz, radius, parent, level = wood
    m, trunk = 0, rule.level == 0
    bare, count = rule.bare_joints, rule.bare_joints + rule.joints
    sway = np.float32(2.0 * rule.wobble / math.sqrt(count))
    shrink, start = np.float32(1.0 - rule.taper), np.float32(rule.start)
    high_step = (_ONE - start) / np.float32(rule.joints)
    length, shortening = np.float32(rule.length), np.float32(rule.shortening)
    variation, per_whorl = np.float32(rule.variation), np.float32(1.0 / rule.whorl)
    cosine, sine = np.float32(math.cos(rule.angle)), np.float32(math.sin(rule.angle))
    for s in range(n_stems):
        x, y, z = stems[0, s], stems[1, s], stems[2, s]
        dx, dy, dz = stems[3, s], stems[4, s], stems[5, s]
        t = _ZERO
        before = np.int32(stems[8, s])
        sum_x = sum_y = _ZERO
        for i in range(1, count + 1):
            if n >= len(radius):
                return n, m, True
            joint = child_key(keys[s], i)
            wx, wy, wz, spin = four(joint)
            now = start * np.float32(i) / np.float32(bare) if i <= bare else start + high_step * np.float32(i - bare)
            step, t = now - t, now
            rightwards, upwards = np.float32(rule.rightwards) * step, np.float32(rule.upwards) * step
            step *= stems[6, s]
            dx, dy, dz = unit(
                dx + sway * (wx - _HALF) + rightwards, dy + sway * (wy - _HALF), dz + sway * (wz - _HALF) + upwards
            )  # fmt: skip
            x += dx * step
            y += dy * step
            z = max(z + dz * step, _ZERO)
            r = stems[7, s] * (_ONE - t * shrink)
            xyz[0, n], xyz[1, n], xyz[2, n] = x, y, z
            radius[n], parent[n], level[n] = r, before, rule.level
            before = np.int32(n)
            n += 1
            if rule.last or i <= bare:
                continue
            reach = stems[6, s] * length * (_ONE - shortening * t)
            if trunk:
                high = np.float32(i - bare) / np.float32(rule.joints)
                reach = np.float32(stems[6, s] * length * envelope(float(high), crown))
                bend = rule.angle + crown.angle_change * high
                cosine, sine = np.float32(math.cos(bend)), np.float32(math.sin(bend))
            for w in range(rule.whorl if i < count else 1):
                if m >= next_stems.shape[1]:
                    return n, m, True
                twig = child_key(joint, CHILD + w)
                spread, vary, _, _ = four(twig)
                cx, cy, cz = dx, dy, dz  # the last child goes straight on
                if i < count:
                    turn = spin + (np.float32(w) + np.float32(0.6) * (spread - _HALF)) * per_whorl
                    cx, cy, cz = _child(dx, dy, dz, cosine, sine, turn, sum_x, sum_y)
                    sum_x += cx
                    sum_y += cy
                long = reach * (_ONE + variation * (np.float32(2.0) * vary - _ONE))
                if trunk:
                    long *= _ONE + np.float32(crown.asymmetry) * cx
                if long < rule.shortest:
                    continue
                next_stems[0, m], next_stems[1, m], next_stems[2, m] = x, y, z
                next_stems[3, m], next_stems[4, m], next_stems[5, m] = cx, cy, cz
                next_stems[6, m] = long
                next_stems[7, m] = r * np.float32(rule.radius) if i < count else r
                next_stems[8, m] = before
                next_keys[m] = twig
                m += 1
    return n, m, False
