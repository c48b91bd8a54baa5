"""Splats: numba kernels that draw leaves and stems into a z-buffer, dabs in the order of a painter, and shrink."""

from __future__ import annotations

import numpy as np
from numba import njit

from scripts.mask_training.scenery.arrays import Classes, Field, Floats, Image
from scripts.mask_training.scenery.kernels import KERNEL
from scripts.mask_training.scenery.noise import value_noise

WOOD, LEAF, TWIG = 1, 2, 3


@njit(**KERNEL)
def draw_leaves(
    place: Floats, along: Floats, across: Floats, colour: Floats, square: float, rgb: Image, depth: Field, kind: Classes
) -> None:
    """Draw leaves at `place` (k, 3), column, row, depth, with half axes (k, 2) in pixels and `colour` (k, 3).

    Pixels with s^n + t^n <= 1 are of the leaf, n = `square`: 2 is an ellipse, 1 a rhombus. Small depth is near.
    """
    height, width = depth.shape
    for i in range(len(place)):
        x, y, z = place[i, 0], place[i, 1], place[i, 2]
        ux, uy, vx, vy = along[i, 0], along[i, 1], across[i, 0], across[i, 1]
        det = ux * vy - uy * vx
        if abs(det) < 0.02:
            continue
        wide, high = abs(ux) + abs(vx), abs(uy) + abs(vy)
        for r in range(max(0, int(y - high)), min(height - 1, int(y + high)) + 1):
            for c in range(max(0, int(x - wide)), min(width - 1, int(x + wide)) + 1):
                if z >= depth[r, c]:
                    continue
                dx, dy = c + 0.5 - x, r + 0.5 - y
                s, t = (dx * vy - dy * vx) / det, (ux * dy - uy * dx) / det
                inside = s * s + t * t <= 1 if square == 2 else abs(s) + abs(t) <= 1
                if inside:
                    depth[r, c], kind[r, c] = z, LEAF
                    # the tip is a little lighter than the base: leaves stay apart
                    tone = 1 + 0.12 * s
                    for k in range(3):
                        rgb[r, c, k] = colour[i, k] * tone


@njit(**KERNEL)
def draw_stems(
    ends: Floats, light: Floats, level: Classes, bark: Floats, sun: Floats, rgb: Image, depth: Field, kind: Classes
) -> None:
    """Draw tapered stems; `ends` (n, 8) are column, row, depth, radius at both ends, in pixels.

    `light` (n, 4) is the share of the sun's and of the sky's light at both ends; `level` 0 is wood, 1 a twig.
    `bark` (12,) is two linear colours, roughness, scale in pixels, depth of marks, seed, strength of sun and sky;
    `sun` (3,) points right, up, towards the viewer.
    """
    height, width = depth.shape
    scale, seed = bark[7], int(bark[9])
    for i in range(len(ends)):
        ax, ay, az, ra, bx, by, bz, rb = ends[i]
        dx, dy = bx - ax, by - ay
        length = np.sqrt(dx * dx + dy * dy) + 1e-3
        far = max(ra, rb, 0.5)
        for r in range(max(0, int(min(ay, by) - far)), min(height - 1, int(max(ay, by) + far)) + 1):
            for c in range(max(0, int(min(ax, bx) - far)), min(width - 1, int(max(ax, bx) + far)) + 1):
                px, py = c + 0.5 - ax, r + 0.5 - ay
                t = (px * dx + py * dy) / (length * length)
                if t < 0 and length > 1:  # the stem before is round at its end, the foot of the tree is not
                    continue
                t = min(max(t, 0.0), 1.0)
                radius = ra + t * (rb - ra)
                ox, oy = px - t * dx, py - t * dy
                off = np.sqrt(ox * ox + oy * oy)
                if off >= max(radius, 0.5):
                    continue
                if radius < 0.5 and value_noise(c * 7.31, r * 5.17, seed) * 0.5 > radius:
                    continue
                u = min(off / max(radius, 0.5), 1.0)
                bulge = np.sqrt(1 - u * u)
                z = az + t * (bz - az) - radius * bulge
                if z >= depth[r, c]:
                    continue
                nx, ny = (ox / off * u, oy / off * u) if off > 0.01 else (0.0, 0.0)
                side = u if px * dy - py * dx > 0 else -u
                lit = max(0.0, nx * sun[0] - ny * sun[1] + bulge * sun[2])
                tone = 0.0
                if radius > 1.0:
                    # cracks run along the stem, marks across it
                    cracks = value_noise(np.arcsin(side) * radius / scale * 1.6, (r + c * 0.3) / scale * 0.22, seed)
                    fine = value_noise(side * radius / scale * 3.1, (r - c * 0.2) / scale * 0.9, seed + 1)
                    tone = bark[6] * (1.3 * (cracks - 0.5) + 0.9 * (fine - 0.5))
                    if bark[8] > 0:
                        mark = value_noise(side * radius / scale * 0.45, r / scale * 1.1, seed + 2)
                        tone -= 1.4 * bark[8] * max(0.0, mark - 0.62)
                depth[r, c], kind[r, c] = z, (TWIG if level[i] == 1 else WOOD)
                mix = value_noise(c / scale * 0.05, r / scale * 0.03, seed + 3)
                open_sun = light[i, 0] + t * (light[i, 2] - light[i, 0])
                open_sky = light[i, 1] + t * (light[i, 3] - light[i, 1])
                shine = bark[10] * open_sun * lit
                if open_sun < 0.9:  # specks of sun that come through the leaves
                    shine *= 0.4 + 1.6 * max(
                        0.0, min(1.0, 4 * value_noise(c / scale * 0.3, r / scale * 0.3, seed + 4) - 1.7)
                    )
                ambient = bark[11] * open_sky * (0.55 + 0.45 * bulge)
                for k in range(3):
                    body = bark[k] + (bark[3 + k] - bark[k]) * mix
                    bright = body * max(0.15, 1 + tone) * (shine + ambient)
                    rgb[r, c, k] = min(1.0, bright) ** 0.4545


@njit(**KERNEL)
def dab(picture: Image, dabs: Floats) -> None:
    """Paint ellipses over `picture`, one after the other.

    `dabs` (n, 9): column, row, half length, half width, angle, r, g, b, opacity; edges are soft over half a pixel.
    """
    height, width = picture.shape[:2]
    for i in range(len(dabs)):
        x, y, a, b, turn, opacity = dabs[i, 0], dabs[i, 1], dabs[i, 2], dabs[i, 3], dabs[i, 4], dabs[i, 8]
        ca, sa = np.cos(turn), np.sin(turn)
        wide = np.sqrt((a * ca) ** 2 + (b * sa) ** 2) + 0.5
        high = np.sqrt((a * sa) ** 2 + (b * ca) ** 2) + 0.5
        small = max(min(a, b), 0.3)
        thin = opacity * min(1.0, min(a, b) / 0.3)
        for r in range(max(0, int(y - high)), min(height - 1, int(y + high)) + 1):
            for c in range(max(0, int(x - wide)), min(width - 1, int(x + wide)) + 1):
                dx, dy = c + 0.5 - x, r + 0.5 - y
                s, t = (dx * ca + dy * sa) / max(a, 0.3), (dy * ca - dx * sa) / small
                inside = (1 - np.sqrt(s * s + t * t)) * small + 0.5
                if inside <= 0:
                    continue
                share = thin * min(inside, 1.0)
                for k in range(3):
                    picture[r, c, k] += (dabs[i, 5 + k] - picture[r, c, k]) * share


@njit(**KERNEL)
def shrink(rgb: Image, kind: Classes, factor: int) -> tuple[Image, Field, Field, Field]:
    """Colour of what is drawn, and shares of wood, leaves and twigs, in blocks of `factor` x `factor` pixels."""
    height, width = kind.shape[0] // factor, kind.shape[1] // factor
    colour = np.zeros((height, width, 3), np.float32)
    shares = np.zeros((4, height, width), np.float32)
    part = np.float32(1.0 / (factor * factor))
    for r in range(height * factor):
        for c in range(width * factor):
            found = kind[r, c]
            if found:
                shares[found, r // factor, c // factor] += part
                for k in range(3):
                    colour[r // factor, c // factor, k] += rgb[r, c, k] * part
    for r in range(height):
        for c in range(width):
            drawn = shares[1, r, c] + shares[2, r, c] + shares[3, r, c]
            if drawn > 0:
                for k in range(3):
                    colour[r, c, k] /= drawn
    return colour, shares[1], shares[2], shares[3]
