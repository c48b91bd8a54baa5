"""Contour distance: how far the outlines of two silhouettes, with those of their gaps, lie from each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Region = NDArray[np.bool_]  # (h, w)


def contour_distance(target: Region, plant: Region) -> float:
    """Mean distance of two silhouettes (h, w) in % of their height h: (d(T, P) + d(P, T)) / 2.

    d(A, B) is the mean over the contour pixels of A of the distance to the nearest contour pixel of B. 100 when one
    silhouette is empty, 0 when both are.
    """
    one, two = contour(target), contour(plant)
    if not one.any() or not two.any():
        return 0.0 if bool(one.any()) == bool(two.any()) else 100.0
    return 50.0 * (_mean_distance(one, two) + _mean_distance(two, one)) / len(target)


def contour(silhouette: Region) -> Region:
    """Pixels (h, w) of a silhouette one of whose 4 neighbours is not in it; all around the mask is outside."""
    inside: Region = ndimage.binary_erosion(silhouette)
    return silhouette & ~inside


def _mean_distance(one: Region, two: Region) -> float:
    """Mean over the pixels of `one` of the distance to the nearest of `two`, in pixels."""
    return float(ndimage.distance_transform_edt(~two)[one].mean())
