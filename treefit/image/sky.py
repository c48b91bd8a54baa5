"""Sky of a photograph: what is smooth at the upper border, and what has its colours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from skimage.color import rgb2lab

from treefit.image.picture import Region, Rgb

Lab = NDArray[np.float64]
"""(h, w, 3) CIE L* 0..100, a*, b*."""

SMOOTH = 4.0
BLUE = -20.0
COLOURS = 6
COLOUR_DISTANCE = 13.0
LEAST_SKY = 0.01
LEAST_BLUE = 0.05
SAMPLES = 3000


def find_sky(lab: Lab) -> Region:
    """(h, w) bool: sky, with its gaps through a crown; empty when nothing at the upper border looks like sky."""
    height = len(lab)
    seeds = _smooth_top(lab)
    blue = is_blue(lab)
    blue[int(0.6 * height) :] = False
    if blue.mean() > LEAST_BLUE:
        # a leafless crown over the whole picture leaves no smooth part
        seeds |= blue
    if seeds.mean() < LEAST_SKY:
        return np.zeros_like(seeds)
    sky = seeds | (_distance_to_colours(lab, _colours(lab[seeds])) < COLOUR_DISTANCE)
    lowest = np.flatnonzero(seeds.mean(axis=1) > 0.02)
    sky[int((lowest[-1] if len(lowest) else height) + 0.05 * height) :] = False
    return sky


def is_blue(lab: Lab) -> Region:
    """(h, w) bool: of a blue that skies and lakes have, and no tree."""
    return np.asarray((lab[..., 2] < BLUE) & (lab[..., 0] > 25))


def gaps(rgb: Rgb, inside: Region, sky: Lab) -> Region:
    """(h, w) bool: pixels of `rgb` that are `inside` and of a colour of the `sky`, whose pixels (n, 3) are given."""
    found = np.zeros_like(inside)
    if len(sky) and inside.any():
        found[inside] = _distance_to_colours(rgb2lab(rgb[inside][None]), _colours(sky))[0] < COLOUR_DISTANCE
    return found


def steepness(lab: Lab, sigma: float) -> NDArray[np.float64]:
    """(h, w): gradient magnitude of all three channels at scale `sigma` in pixels, in Lab units a pixel."""
    channels = [ndimage.gaussian_gradient_magnitude(lab[..., channel], sigma) for channel in range(3)]
    return np.asarray(np.sqrt(sum(channel**2 for channel in channels)))


def _smooth_top(lab: Lab) -> Region:
    """Smooth parts of a colour that skies have, that hang on the top or the upper sides."""
    height = len(lab)
    soft = ndimage.gaussian_filter(lab, (1, 1, 0))
    light, red, yellow = soft[..., 0], soft[..., 1], soft[..., 2]
    likely = (yellow < 12) & (red < 25) & ((light > 55) | (yellow < -8)) & ~((red < -8) & (yellow > 6))
    smooth = ndimage.binary_opening((steepness(lab, 1.0) < SMOOTH) & (light > 25), iterations=2)
    labels, _ = ndimage.label(smooth & likely)
    upper = labels[: height // 3]
    border = np.concatenate((labels[: max(2, height // 50)].ravel(), upper[:, :2].ravel(), upper[:, -2:].ravel()))
    return np.asarray(np.isin(labels, np.unique(border[border > 0])))


def _colours(pixels: Lab) -> Lab:
    """(k, 3) typical colours of `pixels` (n, 3) by k-means; evenly spaced samples make it deterministic."""
    pixels = pixels[:: max(1, len(pixels) // SAMPLES)]
    order = np.argsort(pixels[:, 0], kind="stable")
    centres = pixels[order[np.linspace(0, len(pixels) - 1, COLOURS).astype(int)]]
    for _ in range(12):
        nearest = ((pixels[:, None] - centres) ** 2).sum(axis=-1).argmin(axis=1)
        for index in np.unique(nearest):
            centres[index] = pixels[nearest == index].mean(axis=0)
    return np.asarray(centres)


def _distance_to_colours(lab: Lab, centres: Lab) -> NDArray[np.float64]:
    nearest = np.full(lab.shape[:2], np.inf)
    for centre in centres:
        np.minimum(nearest, ((lab - centre) ** 2).sum(axis=-1), out=nearest)
    return np.asarray(np.sqrt(nearest))
