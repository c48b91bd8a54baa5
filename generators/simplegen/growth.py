"""Growth of SimpleGen: level by level, so that parents come before children and the budget cuts the finest first."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from treefit.plant.streams import child_key, circle, signed, uniform

AZIMUTH, LENGTH, WOBBLE_X, WOBBLE_Y, WOBBLE_Z, KEPT, ALONG, SPIN, SCALE = range(9)  # purposes of the draws

STEM_FIELDS = 9  # position x y z, direction x y z, length, radius, parent vertex


@njit(cache=True, nogil=True)
def children_of(count: int, start: float, whorl: int) -> int:
    """Count of children of a branch with `count` joints, bare up to the share `start`."""
    n = 1
    for i in range(1, count):
        if i >= start * count:
            n += whorl
    return n


@njit(cache=True, nogil=True)
def envelope(h: float, bottom: float, peak: float, top: float, low: float, high: float) -> float:
    """Length of a branch at the height h in [0, 1] of the crown, by the longest."""
    if h < peak:
        return bottom + (1.0 - bottom) * (h / peak) ** low
    if peak >= 1.0:
        return 1.0
    return top + (1.0 - top) * ((1.0 - h) / (1.0 - peak)) ** high


@njit(inline="always")
def _frame(x, y, z):
    """Two unit vectors at right angles to the unit vector (x, y, z), and to each other."""
    sign = np.float32(1.0) if z >= 0 else np.float32(-1.0)
    a = np.float32(-1.0) / (sign + z)
    b = x * y * a
    return np.float32(1.0) + sign * x * x * a, sign * b, -sign * x, b, sign + y * y * a, -y


@njit(inline="always")
def _turned(x, y, z, c, s, turn):
    """Unit vector at the angle of cosine c and sine s from the unit vector (x, y, z), `turn` turns around it."""
    ux, uy, uz, wx, wy, wz = _frame(x, y, z)
    p, q = circle(turn)
    p *= s
    q *= s
    return c * x + p * ux + q * wx, c * y + p * uy + q * wy, c * z + p * uz + q * wz


@njit(inline="always")
def _unit(x, y, z):
    n = np.float32(1.0) / (np.float32(math.sqrt(x * x + y * y + z * z)) + np.float32(1e-12))
    return x * n, y * n, z * n


@njit(cache=True, nogil=True)
def grow_level(
    level, last, stems, keys, n_stems, length, angle, angle_change, count, start, whorl, radius_share, taper, droop,
    lean_turn, wobble, crown, asymmetry, variation, shortening, shortest, xyz, radius, parent, levels, n, max_vertices,
    next_stems, next_keys,
):  # fmt: skip
    """Grow all branches of one level into the arrays from vertex n on; return (n, count of next stems, cut).

    `length`, `radius_share` are those of the children; `crown` is the envelope of level 1, or empty.
    """
    m = 0
    for s in range(n_stems):
        x, y, z = stems[0, s], stems[1, s], stems[2, s]
        dx, dy, dz = stems[3, s], stems[4, s], stems[5, s]
        step = stems[6, s] / np.float32(count)
        thick = stems[7, s]
        before = np.int32(stems[8, s])
        key = keys[s]
        turn = np.float32(droop / count)
        sway = np.float32(wobble / math.sqrt(count))
        sum_x = sum_y = np.float32(0.0)
        for i in range(1, count + 1):
            if n >= max_vertices:
                return n, m, True
            joint = child_key(key, i)
            dx += sway * signed(joint, WOBBLE_X) + np.float32(lean_turn / count)
            dy += sway * signed(joint, WOBBLE_Y)
            dz += sway * signed(joint, WOBBLE_Z) + turn
            dx, dy, dz = _unit(dx, dy, dz)
            x += dx * step
            y += dy * step
            z = max(z + dz * step, np.float32(0.0))
            t = i / count
            r = thick * np.float32(1.0 - t * (1.0 - taper))
            xyz[0, n], xyz[1, n], xyz[2, n] = x, y, z
            radius[n], parent[n], levels[n] = r, before, level
            before = np.int32(n)
            n += 1
            if last or (i < start * count and i < count):
                continue
            along = (t - start) / max(1.0 - start, 1e-6)
            reach = stems[6, s] * length * (1.0 - shortening * t)
            bend = angle
            if level == 0:
                reach = stems[6, s] * length * envelope(along, crown[0], crown[1], crown[2], crown[3], crown[4])
                bend = angle + angle_change * along
            cosine, sine = np.float32(math.cos(bend)), np.float32(math.sin(bend))
            for w in range(whorl if i < count else 1):
                twig = child_key(joint, 16 + w)
                azimuth = uniform(joint, AZIMUTH) + np.float32((w + 0.3 * signed(twig, SPIN)) / whorl)
                cx, cy, cz = dx, dy, dz
                if i < count:
                    cx, cy, cz = _turned(dx, dy, dz, cosine, sine, azimuth)
                    # pushed away from the earlier siblings, as far to the side as before
                    side = math.sqrt(cx * cx + cy * cy)
                    total = math.sqrt(sum_x * sum_x + sum_y * sum_y) + 1e-6
                    cx -= np.float32(0.5 * side * sum_x / (total + 0.5))
                    cy -= np.float32(0.5 * side * sum_y / (total + 0.5))
                    stretch = np.float32(side / (math.sqrt(cx * cx + cy * cy) + 1e-6))
                    cx *= stretch
                    cy *= stretch
                    cx, cy, cz = _unit(cx, cy, cz)
                    sum_x += cx
                    sum_y += cy
                long = reach * (1.0 + variation * signed(twig, LENGTH)) * (1.0 + asymmetry * cx)
                if long < shortest:
                    continue
                if m >= next_stems.shape[1]:
                    return n, m, True
                next_stems[0, m], next_stems[1, m], next_stems[2, m] = x, y, z
                next_stems[3, m], next_stems[4, m], next_stems[5, m] = cx, cy, cz
                next_stems[6, m] = long
                next_stems[7, m] = r * radius_share if i < count else r
                next_stems[8, m] = before
                next_keys[m] = twig
                m += 1
    return n, m, False


@njit(cache=True, nogil=True)
def grow_leaves(
    first, n, xyz, parent, keys, count, start, angle, probability, number, length, width, leaf_xyz, leaf_axis, leaf_normal,
    leaf_size, max_leaves,
):  # fmt: skip
    """Put leaves at the joints of the last level, vertices first..n; return (count of leaves, cut)."""
    k = 0
    cosine, sine = np.float32(math.cos(angle)), np.float32(math.sin(angle))
    length, width, share = np.float32(length), np.float32(width), np.float32(1.0 / number)
    for v in range(first, n):
        i = (v - first) % count + 1
        if i < start * count and i < count:
            continue
        joint = child_key(keys[(v - first) // count], i)
        p = parent[v]
        sx, sy, sz = xyz[0, v] - xyz[0, p], xyz[1, v] - xyz[1, p], xyz[2, v] - xyz[2, p]
        dx, dy, dz = _unit(sx, sy, sz)
        spin = uniform(joint, SPIN)
        for j in range(number):
            leaf = child_key(joint, 64 + j)
            if uniform(leaf, KEPT) >= probability:
                continue
            if k >= max_leaves:
                return k, True
            azimuth = spin + (np.float32(j) + np.float32(0.5) * uniform(leaf, AZIMUTH)) * share
            ax, ay, az = _turned(dx, dy, dz, cosine, sine, azimuth)
            bx, by, bz = _turned(ax, ay, az, np.float32(0.0), np.float32(1.0), uniform(leaf, SPIN))
            if bz < 0:  # the upper side to the sky
                bx, by, bz = -bx, -by, -bz
            back = uniform(leaf, ALONG)
            scale = np.float32(1.0) + np.float32(0.3) * signed(leaf, SCALE)
            leaf_xyz[0, k], leaf_xyz[1, k] = xyz[0, v] - back * sx, xyz[1, v] - back * sy
            leaf_xyz[2, k] = xyz[2, v] - back * sz
            leaf_axis[0, k], leaf_axis[1, k], leaf_axis[2, k] = ax, ay, az
            leaf_normal[0, k], leaf_normal[1, k], leaf_normal[2, k] = bx, by, bz
            leaf_size[0, k], leaf_size[1, k] = length * scale, width * scale
            k += 1
    return k, False
