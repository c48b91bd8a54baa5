"""Growth of SimpleGen's trunk and of where its branches begin."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.simplegen.crown import DEPTH, KEEP, TURN, reach
from generators.simplegen.directions import aside, unit
from generators.simplegen.rules import CHILD, SWAY
from treefit.plant.compiling import INNER
from treefit.plant.streams import child_key, circle, two

_HALF, _ZERO, _ONE, _TWO, _SPREAD, _TINY = (np.float32(x) for x in (0.5, 0.0, 1.0, 2.0, 0.6, 1e-6))


@njit(**INNER)
def flattened(x, y, z, depth):
    """Direction with its part along y times `depth`, as far to the side as before."""
    flat = depth * y
    stretch = math.sqrt((x * x + y * y + _TINY) / (x * x + flat * flat + _TINY))
    return unit(x * stretch, flat * stretch, z)


@njit(**INNER)
def grow_trunk(rule, crown, length, base_radius, lean, key, wood, stems):
    """Grow the trunk into `wood`, its branches into `stems`; return (vertices, branches, whether the budget cut it)."""
    numbers, integers = wood
    numbers[:3, 0], numbers[3, 0] = _ZERO, base_radius
    integers[0, 0], integers[1, 0] = -1, 0
    n, m, count, bare, whorl = 1, 0, int(rule.bare_joints + rule.joints), int(rule.bare_joints), int(rule.whorl)
    sway, shrink, start = np.float32(2.0 * rule.wobble / math.sqrt(count)), np.float32(1.0 - rule.taper), rule.start
    x = y = z = t = dy = sum_x = sum_y = _ZERO
    dx, dz = np.float32(math.sin(lean)), np.float32(math.cos(lean))
    for i in range(1, count + 1):
        if n >= numbers.shape[1]:
            return n, m, True
        joint = child_key(key, i)
        wx, wy = two(joint)
        wz, spin = two(child_key(joint, SWAY))
        high = np.float32((i - bare) / rule.joints)
        now = np.float32(start * i / bare if high <= _ZERO else start + (1.0 - start) * high)
        step, t = now - t, now
        dx, dy, dz = unit(
            dx + sway * (wx - _HALF) + np.float32(rule.rightwards) * step,
            dy + sway * (wy - _HALF), dz + sway * (wz - _HALF) + np.float32(rule.upwards) * step,
        )  # fmt: skip
        step *= np.float32(length)
        x, y, z = x + dx * step, y + dy * step, max(z + dz * step, _ZERO)
        r = np.float32(base_radius) * (_ONE - t * shrink)
        numbers[0, n], numbers[1, n], numbers[2, n], numbers[3, n] = x, y, z, r
        integers[0, n], integers[1, n] = n - 1, 0
        n += 1
        if high <= _ZERO:
            continue
        bend = rule.angle + crown[TURN] * high
        cosine, sine = np.float32(math.cos(bend)), np.float32(math.sin(bend))
        for w in range(whorl if i < count else 1):
            if m >= len(stems.keys):
                return n, m, True
            twig = child_key(joint, CHILD + w)
            spread, vary = two(twig)
            cx, cy, cz = dx, dy, dz  # the last child goes straight on
            if i < count:
                p, q = circle(spin + (np.float32(w) + _SPREAD * (spread - _HALF)) / np.float32(whorl))
                cx, cy, cz = aside(dx, dy, dz, cosine, sine, p, q, sum_x, sum_y)
                cx, cy, cz = flattened(cx, cy, cz, crown[DEPTH])
                sum_x, sum_y = sum_x + cx, sum_y + cy
            full = reach(crown, x, y, z, cx, cy, cz + _HALF * np.float32(rule.child_upwards), np.float32(2.0 * length))
            long = np.float32(length * rule.length)
            long += crown[KEEP] * (full - long)
            long *= _ONE + np.float32(rule.variation) * (_TWO * vary - _ONE)
            if long < rule.shortest:
                continue
            stems.fields[0, m], stems.fields[1, m], stems.fields[2, m] = x, y, z
            stems.fields[3, m], stems.fields[4, m], stems.fields[5, m] = cx, cy, cz
            stems.fields[6, m], stems.fields[7, m] = long, r * np.float32(rule.radius) if i < count else r
            stems.fields[8, m], stems.keys[m] = n - 1, twig
            m += 1
    return n, m, False
