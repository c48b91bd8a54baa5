"""Shapes: numbers of the paper by which length and radius follow the place on a stem (sec. 4.3, 4.4 and 4.7)."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from generators.weberpenn.power import power
from treefit.plant.compiling import INNER

_ZERO, _HALF, _ONE, _TWO, _EIGHT = (np.float32(x) for x in (0.0, 0.5, 1.0, 2.0, 8.0))
_CONE, _REST, _PEAK = np.float32(0.2), np.float32(0.8), np.float32(0.7)
_CLOSE = np.float32(1e-6)


@njit(**INNER)
def shape_ratio(shape, r, tree):
    """ShapeRatio(shape, r): length of a limb by the longest, r being 0 at the top of the crown and 1 at its bottom."""
    r = min(max(r, _ZERO), _ONE)
    if shape == 0:
        return _CONE + _REST * r
    if shape == 1:
        return _CONE + _REST * np.float32(math.sin(math.pi * r))
    if shape == 2:
        return _CONE + _REST * np.float32(math.sin(_HALF * math.pi * r))
    if shape == 3:
        return _ONE
    if shape == 4:
        return _HALF + _HALF * r
    if shape == 5:
        return r / _PEAK if r <= _PEAK else (_ONE - r) / (_ONE - _PEAK)
    if shape == 6:
        return _ONE - _REST * r
    if shape == 7:
        return _HALF + _HALF * (r / _PEAK if r <= _PEAK else (_ONE - r) / (_ONE - _PEAK))
    return envelope(r, tree)


@njit(**INNER)
def envelope(r, tree):
    """ShapeRatio(8, r): radius of the pruning envelope by its greatest; 0 outside of [0, 1]."""
    peak = np.float32(tree.prune_peak)
    over = r < _ONE - peak
    share = r / (_ONE - peak) if over else (_ONE - r) / peak
    radius = power(max(share, _ZERO), np.float32(tree.prune_high if over else tree.prune_low))
    return _ZERO if r < _ZERO or r > _ONE else radius


@njit(**INNER)
def unit_taper(taper):
    """Loss of radius from base to tip of the cone in which a stem of this taper lies."""
    if taper < _ONE:
        return np.float32(taper)
    return np.float32(_TWO - taper) if taper < _TWO else _ZERO


@njit(**INNER)
def radius_at(taper, z, radius, length):
    """Radius of a stem at the share `z` of its length (sec. 4.4): cone, rounded end, or spheres in a row."""
    cone = radius * (_ONE - unit_taper(taper) * z)
    if taper < _ONE:
        return cone
    left = (_ONE - z) * length
    from_middle = left
    if taper >= _TWO:
        from_middle = abs(left - _TWO * cone * math.floor(left / max(_TWO * cone, _CLOSE) + _HALF))
    if taper < _TWO and from_middle >= cone:
        return cone
    depth = _ONE if taper < _TWO or left < cone else np.float32(taper - _TWO)
    rounded = math.sqrt(max(cone * cone - (from_middle - cone) * (from_middle - cone), _ZERO))
    return (_ONE - depth) * cone + depth * rounded


@njit(**INNER)
def flare_at(flare, z):
    """Factor of the trunk's radius at the share `z` of its length: the root flare (sec. 4.4)."""
    y = max(_ZERO, _ONE - _EIGHT * z)
    return _ONE + np.float32(flare) * np.float32(100.0**y - 1.0) / np.float32(100.0)
