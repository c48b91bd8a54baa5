"""The tree by what the user says of it: an outline and strokes lead the soft cut, the extractor's answer helps."""

from __future__ import annotations

import numpy as np
from PIL import Image
from scipy import ndimage
from skimage.color import rgb2lab

from treefit.image.cut import soft_cut
from treefit.image.guided import upsample
from treefit.image.help import Window
from treefit.image.help_odds import NOT_TREE, TREE, Odds, Said, odds_of
from treefit.image.picture import Picture, Region, Rgb, cut_out, shrink
from treefit.image.resize import resize_mask, resize_strokes
from treefit.image.sky import find_sky, is_blue
from treefit.mask import Mask

COARSE, FINE = 256, 768
MARGIN = 0.3
BANDS = 16
REACH, SMOOTHNESS = 4, 3e-4
"""Pixels of the small picture by which an edge may move to one of the colours; how little counts as one."""


def cut_tree(picture: Picture, said: Said) -> Region:
    """(h, w) bool: the tree that fits what is `said` and the colours of `picture`."""
    window = surroundings(said.outline, picture.shape)
    part = cut_out(picture, *window)
    small = shrink(part, COARSE)
    lab = rgb2lab(small.rgb)
    sky = resize_mask(_sky(picture)[window].astype(np.uint8), small.shape).astype(bool)
    seen = _seen(said, window, small.shape)
    painted = np.zeros_like(sky) if seen.strokes is None else np.isin(seen.strokes, TREE)
    if sky[painted].sum() > painted.sum() / 2:
        sky[:] = False  # what the user calls tree looks like sky: blossom, snow, fog
    odds, known = odds_of(seen, lab, sky)
    sky &= ~known.tree
    likely = soft_cut(lab, odds, sky, known, BANDS)
    tree = np.zeros(picture.shape, dtype=bool)
    tree[window] = resize_mask(_sharpen(likely, sky, shrink(part, FINE).rgb), part.shape).astype(bool)
    if said.strokes is not None:
        tree = (tree | np.isin(said.strokes, TREE)) & (said.strokes != NOT_TREE)
    return tree


def surroundings(outline: Region | None, shape: tuple[int, int]) -> Window:
    """Rows and columns around `outline` with some of its surroundings, which teach what is not tree."""
    if outline is None:
        return slice(0, shape[0]), slice(0, shape[1])
    spans = [np.flatnonzero(outline.any(axis=axis)) for axis in (1, 0)]
    margin = round(MARGIN * max(int(span[-1] - span[0]) + 1 for span in spans))
    low, high = ([int(span[end]) for span in spans] for end in (0, -1))
    rows, columns = (slice(max(0, low[k] - margin), min(shape[k], high[k] + 1 + margin)) for k in (0, 1))
    return rows, columns


def _sky(picture: Picture) -> Region:
    """(h, w) bool: sky of the whole picture, whose upper border tells what sky is."""
    lab = rgb2lab(shrink(picture, FINE).rgb)
    sky = find_sky(lab) | is_blue(lab)
    return resize_mask(sky.astype(np.uint8), picture.shape).astype(bool)


def _seen(said: Said, window: Window, shape: tuple[int, int]) -> Said:
    """`said` of the `window`, at `shape`; a stroke is kept however thin it is."""
    first = resize_mask(np.ascontiguousarray(said.first[window]), shape)
    outline = None if said.outline is None else resize_mask(said.outline[window].astype(np.uint8), shape).astype(bool)
    strokes = None if said.strokes is None else resize_strokes(said.strokes[window], shape)
    return Said(first, outline, strokes)


def _sharpen(likely: Odds, sky: Region, fine: Rgb) -> Mask:
    """(h, w) 0 or 1 at the size of `fine`: where tree is more `likely` than not, without the sky in its gaps."""
    coarse = np.asarray(Image.fromarray(fine).resize(likely.shape[::-1], Image.Resampling.BOX))
    large = upsample(likely.astype(np.float32)[..., None], coarse, fine, REACH, SMOOTHNESS)[..., 0]
    near_sky = resize_mask(ndimage.binary_dilation(sky).astype(np.uint8), fine.shape[:2]).astype(bool)
    lab = rgb2lab(fine)
    return np.asarray((large > 0.5) & ~((find_sky(lab) | is_blue(lab)) & near_sky)).astype(np.uint8)
