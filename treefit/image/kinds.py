"""Branch or foliage inside a tree whose region is known: a network's belief, checked by geometry and colour."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from treefit.image.belief import Belief
from treefit.image.classes import leaf_share
from treefit.image.picture import Region, Rgb
from treefit.image.trunk import trunk_column
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

Odds = NDArray[np.float32]
"""(h, w) float32: natural logarithm of how much likelier branch is than foliage."""

LEAST_SURE = 0.02
"""Added to both probabilities: a network that says 0 is not to be believed that much."""

COLOUR_WEIGHT, COLOUR_LIMIT = 2.0, 1.0
"""Log odds of a colour are cut at the limit, then multiplied by the weight."""

LEVELS = 8
"""Steps of red, of green and of blue in which colours are counted."""

RARE = 1e-4
"""Share of the pixels that each colour is taken to have besides those counted."""

BLUR = 3
"""Side in pixels of the square over which the odds of colours are averaged: single leaves and grain say little."""

SPECK = 0.001
"""A part off the trunk is a speck when its log odds sum to less than this share of the number of the tree's pixels."""

CLEAR = 0.5
"""Share of branch from which the column under the crown counts as a trunk, whose gaps are filled."""

GAP = 0.08
"""Height of the longest gap that is filled, in heights of the tree."""

LEAST_BARE = 0.05
"""Branch share under which no tree is leafless, however lacy and colourless: then it is a leafy tree against light."""

BARE, BARE_LEAF, BARE_FILLED = -0.52, 0.4, 0.8
"""It must exceed the first too, plus the second times the share of leaf colours, plus the third times `_filled`."""

LOOK = 5000
"""About as many pixels are looked at for leaf colours."""


def kinds(rgb: Rgb, tree: Region, belief: Belief) -> Mask:
    """Mask (h, w) of `tree` (h, w): branch or foliage by the odds of `belief` (h, w, 3) and of colours.

    The region stays as it is. The trunk gets no gaps, unsure specks become foliage, and a leafless tree is all branch.
    """
    if not tree.shape == rgb.shape[:2] == belief.shape[:2]:
        raise ValueError(f"kinds: picture {rgb.shape}, tree {tree.shape}, belief {belief.shape} must have one size")
    mask = np.where(tree, FOLIAGE, BACKGROUND).astype(np.uint8)
    if tree.any():
        box = ndimage.find_objects(tree.astype(np.uint8))[0]
        rgb, tree, belief = rgb[box], tree[box], belief[box]
        column = trunk_column(tree)
        wood = tree if _leafless(rgb, tree, belief, column) else _wood(rgb, tree, belief, column)
        mask[box][wood] = BRANCH
    return mask


def is_leafless(rgb: Rgb, tree: Region, belief: Belief) -> bool:
    """Whether `tree` (h, w), of at least a pixel, has no leaves, so that all of it is branch."""
    return _leafless(rgb, tree, belief, trunk_column(tree))


def _leafless(rgb: Rgb, tree: Region, belief: Belief, column: Region) -> bool:
    """By the median of the crown: a few thick limbs among leaves are as sure as those of a tree without any."""
    crown = tree & ~column
    if not crown.any():
        crown = tree
    kind = belief[crown][:, [BRANCH, FOLIAGE]]
    share = float(np.median(kind[:, 0] / np.maximum(kind.sum(axis=1), 1e-6)))
    needed = BARE + BARE_LEAF * _leaf_colours(rgb, crown) + BARE_FILLED * _filled(tree)
    return share > max(LEAST_BARE, needed)


def _leaf_colours(rgb: Rgb, crown: Region) -> float:
    colours = rgb[crown]
    some = colours[None, :: max(1, len(colours) // LOOK)]
    return leaf_share(some, np.ones(some.shape[:2], bool))


def _filled(tree: Region) -> float:
    """Share of tree between its leftmost and rightmost pixel of each row: low when the sky shows through."""
    rows = tree[tree.any(axis=1)]
    spans = rows.shape[1] - rows.argmax(axis=1) - rows[:, ::-1].argmax(axis=1)
    return float(rows.sum() / spans.sum())


def _wood(rgb: Rgb, tree: Region, belief: Belief, column: Region) -> Region:
    odds = np.log(belief[..., BRANCH] + LEAST_SURE) - np.log(belief[..., FOLIAGE] + LEAST_SURE)
    colour = np.zeros_like(odds)
    colour[tree] = np.clip(_colour_odds(rgb[tree], belief[tree]), -COLOUR_LIMIT, COLOUR_LIMIT)
    odds += COLOUR_WEIGHT * ndimage.uniform_filter(colour, BLUR)
    wood = tree & (odds > 0)
    return _without_specks(wood, odds, tree, column) | _gaps(wood, column)


def _colour_odds(colours: Rgb, belief: Belief) -> Odds:
    """Log odds (n,) of `colours` (n, 3), each by its shares of what `belief` (n, 3) holds for branch and foliage."""
    steps = (colours // (256 // LEVELS)).astype(np.intp)
    place = (steps[:, 0] * LEVELS + steps[:, 1]) * LEVELS + steps[:, 2]
    shares = []
    for kind in (BRANCH, FOLIAGE):
        count = np.bincount(place, belief[:, kind], LEVELS**3)
        count = ndimage.gaussian_filter(count.reshape(LEVELS, LEVELS, LEVELS), 0.7).ravel()
        shares.append(count / max(count.sum(), 1e-6) + RARE)
    odds: Odds = np.log(shares[0] / shares[1]).astype(np.float32)[place]
    return odds


def _without_specks(wood: Region, odds: Odds, tree: Region, column: Region) -> Region:
    """`wood` without small or doubtful parts that do not touch the trunk."""
    parts, count = ndimage.label(wood, np.ones((3, 3)))
    weight = np.bincount(parts.ravel(), odds.ravel(), count + 1)
    keep = weight >= SPECK * tree.sum()
    keep[parts[column]] = True
    keep[0] = False
    return np.asarray(keep[parts])


def _gaps(wood: Region, column: Region) -> Region:
    """Pixels of `column` with wood above and below them, if it is wood for the better part."""
    trunk = wood & column
    if trunk.sum() <= CLEAR * column.sum():
        return np.zeros_like(column)
    side = max(1, round(GAP * len(column))) + 1
    rows = np.pad(trunk, ((side, side), (0, 0)))
    closed = ndimage.minimum_filter1d(ndimage.maximum_filter1d(rows, side, axis=0), side, axis=0)
    return np.asarray(closed[side:-side] & column)
