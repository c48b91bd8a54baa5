"""Overlay: the picture with its mask on it, for a user to check before a long search."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from treefit.image.picture import Picture, Rgb
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

TINTS = {BRANCH: (255, 96, 0), FOLIAGE: (0, 200, 60)}
CONTOUR = (255, 0, 200)
TINT_STRENGTH = 0.45
BACKGROUND_STRENGTH = 0.35
PIXELS_PER_CONTOUR_PIXEL = 400


def overlay(picture: Picture, mask: Mask) -> Rgb:
    """(h, w, 3) uint8: branch and foliage tinted, background paled, the outline of each class drawn."""
    if mask.shape != picture.shape:
        raise ValueError(f"overlay: mask {mask.shape} and picture {picture.shape} must have one size")
    shown = picture.rgb.astype(np.float32)
    _blend(shown, mask == BACKGROUND, (255, 255, 255), BACKGROUND_STRENGTH)
    for kind, tint in TINTS.items():
        _blend(shown, mask == kind, tint, TINT_STRENGTH)
    shown[_contour(mask)] = CONTOUR
    return np.round(shown).astype(np.uint8)


def _blend(shown: np.ndarray, where: np.ndarray, tint: tuple[int, int, int], strength: float) -> None:
    shown[where] += (np.array(tint, np.float32) - shown[where]) * strength


def _contour(mask: Mask) -> np.ndarray:
    """(h, w) bool: edge of the tree, thick enough to be seen when the picture is shown small."""
    tree = mask != BACKGROUND
    thickness = max(1, max(mask.shape) // PIXELS_PER_CONTOUR_PIXEL)
    return np.asarray(tree & ~ndimage.binary_erosion(tree, iterations=thickness, border_value=1))
