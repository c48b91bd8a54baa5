"""Colours of a picture: bark from its branch pixels, leaves from its foliage pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from skimage.color import lab2rgb, rgb2lab

from treefit.asset.material.colour import Colour, of_linear, to_linear_light
from treefit.asset.material.tree_materials import TreeColours
from treefit.mask import BRANCH, FOLIAGE, Mask

Rgb = NDArray[np.uint8]  # (h, w, 3) sRGB
Lab = NDArray[np.float64]  # (n, 3)

FEWEST = 60
"""Pixels of a kind under which its colour is not asked."""
_MOST = 20_000  # pixels that are looked at
_GREY = 7.0  # chroma in Lab under which a pixel has no colour
_COLOURED = 0.02  # share of the picture's pixels that have a colour when the picture has
_BLACK = 14.0  # lightness of the well-lit part under which all is in the dark, as in a silhouette
_LIT = (0.45, 0.9)  # quantiles of lightness between which the well-lit part is: neither shade nor gleam
_GAIN = {BRANCH: 2.0, FOLIAGE: 1.65}
"""Of a dark surface in open light over what a trunk or crown shows of it; the lighter it is, the less."""
_FULL = 0.6  # luminance from which nothing is gained: what is so light stands in open light
_PUREST = 0.05  # least channel by the greatest: no surface takes all light of a colour
_PURER = 1.15  # chroma of a leaf by that of a crown, where the sky is mirrored
_LIGHTEST = {BRANCH: 0.5, FOLIAGE: 0.72}  # of a channel, linear, that a gain does not go beyond
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
_COLOURED_BARK, _PALE_BARK = 0.36, 12.0  # luminance of bark that has a chroma over the second: lighter is the sun's


def image_colours(rgb: Rgb, mask: Mask) -> TreeColours:
    """Return the colours of bark and leaves that `rgb` (h, w, 3) shows where `mask` (h, w) has them.

    They are base colours: lighter than the picture, which has shade in it. A kind of which a drawing without colours,
    a silhouette or too few pixels tell nothing is None.
    """
    if rgb.shape[:2] != mask.shape:
        raise ValueError(f"colours: picture {rgb.shape[:2]} and mask {mask.shape} must be of one size")
    if not _has_colour(rgb, mask):
        return TreeColours()
    return TreeColours(_colour(rgb, mask == BRANCH, BRANCH), _colour(rgb, mask == FOLIAGE, FOLIAGE))


def _has_colour(rgb: Rgb, mask: Mask) -> bool:
    """Whether some part of the tree is more than grey."""
    tree = _few(rgb[mask != 0])
    return len(tree) >= FEWEST and float((_chroma(_lab(tree)) > _GREY).mean()) > _COLOURED


def _colour(rgb: Rgb, there: NDArray[np.bool_], kind: int) -> Colour | None:
    if there.sum() < FEWEST:
        return None
    seen = _lab(_few(rgb[_inner(there)]))
    seen = _unless_few(seen, ~_is_sky(seen))
    if kind == BRANCH:
        seen = _unless_few(seen, ~_is_green(seen))
    low, high = np.quantile(seen[:, 0], _LIT)
    lit = np.median(seen[(seen[:, 0] >= low) & (seen[:, 0] <= high)], axis=0)
    if lit[0] < _BLACK:
        return None
    if kind == BRANCH:
        lit[1] = max(lit[1], -1.0)  # green on bark is the light of the lawn
    else:
        lit[1:] *= _PURER
    return _in_open_light(lit, kind)


def _inner(there: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """What is not at a border, where pixels are mixed; of thin branches the inmost quarter."""
    depth = distance_transform_edt(np.pad(there, 1))[1:-1, 1:-1]
    wanted = max(2.0, 0.006 * max(there.shape))
    return np.asarray(depth > min(wanted, float(np.quantile(depth[there], 0.75)) - 1e-9))


def _is_sky(seen: Lab) -> NDArray[np.bool_]:
    """Pale or bluish pixels, as in gaps between leaves."""
    light, _, yellow = seen.T
    return np.asarray((light > 55) & ((yellow < -4) | ((light > 78) & (_chroma(seen) < 10))))


def _is_green(seen: Lab) -> NDArray[np.bool_]:
    return np.asarray((seen[:, 1] < -5) & (seen[:, 2] > 8))


def _unless_few(seen: Lab, chosen: NDArray[np.bool_]) -> Lab:
    return seen[chosen] if chosen.sum() >= max(FEWEST // 2, 0.25 * len(seen)) else seen


def _in_open_light(lit: Lab, kind: int) -> Colour:
    """The colour as it is without the shade that is in `lit` (3,)."""
    linear = to_linear_light(lab2rgb(lit[None])[0])
    seen = float(linear @ _LUMINANCE)
    gain = 1 + (_GAIN[kind] - 1) * max(1 - seen / _FULL, 0.0)
    gain = min(gain, max(_LIGHTEST[kind] / float(linear.max()), 1.0))
    if kind == BRANCH and np.hypot(lit[1], lit[2]) > _PALE_BARK:
        gain = min(gain, _COLOURED_BARK / seen)
    return of_linear(np.maximum(linear, _PUREST * linear.max()) * gain)


def _few(pixels: Rgb) -> Rgb:
    return pixels[:: max(len(pixels) // _MOST, 1)]


def _lab(pixels: Rgb) -> Lab:
    return np.asarray(rgb2lab(pixels[None])[0])


def _chroma(seen: Lab) -> NDArray[np.float64]:
    return np.hypot(seen[:, 1], seen[:, 2])
