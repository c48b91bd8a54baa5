"""Branch or foliage: splits the pixels of a tree that stands free, by hue where it tells and by geometry else."""

from __future__ import annotations

import numpy as np
from scipy import ndimage
from skimage.color import rgb2hsv, rgb2lab

from treefit.image.picture import Region, Rgb
from treefit.image.trunk import trunk_column
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

GREY_CHROMA = 14.0
DARK = 0.22
WOOD_HUES = (0.0, 0.13)
GREEN_HUES = (0.16, 0.5)
LEAST_FOLIAGE = 0.04
STROKE_SHARE = 0.04
LEAST_SOLID = 0.25
SPECK_SHARE = 0.001


def by_form(tree: Region) -> Mask:
    """Mask of a tree known by its outline only: the narrow column is branch, all is branch when it is mere strokes."""
    mask = np.where(tree, FOLIAGE, BACKGROUND).astype(np.uint8)
    if tree.any() and is_strokes(tree):
        mask[tree] = BRANCH
    else:
        mask[trunk_column(tree)] = BRANCH
    return mask


def by_colour(rgb: Rgb, tree: Region) -> Mask:
    """Mask of a free-standing tree: brown and grey are branch when they hang on the trunk, all else is foliage."""
    if is_colourless(rgb, tree):
        return by_form(tree)
    wood, leaf = _without_specks(_wood(rgb) & tree, tree), _leaf(rgb) & tree
    if leaf.sum() < LEAST_FOLIAGE * tree.sum():
        return np.where(tree, BRANCH, BACKGROUND).astype(np.uint8)
    nearest = ndimage.distance_transform_edt(~(wood | leaf), return_distances=False, return_indices=True)
    wood = wood[tuple(nearest)] & tree
    mask = np.where(tree, FOLIAGE, BACKGROUND).astype(np.uint8)
    mask[_held(wood, tree)] = BRANCH
    return mask


def is_colourless(rgb: Rgb, tree: Region) -> bool:
    """Whether the tree is black, grey or nearly so: its hue says nothing."""
    lab = rgb2lab(rgb[tree][None])[0]
    chroma = np.hypot(lab[:, 1], lab[:, 2])
    return bool(np.mean((chroma < GREY_CHROMA) | (lab[:, 0] < 12)) > 0.9)


def is_strokes(tree: Region) -> bool:
    """Whether the tree is made of thin strokes: little of it is left when strokes are rubbed out."""
    rows = np.flatnonzero(tree.any(axis=1))
    height = int(rows[-1] - rows[0] + 1)
    inside = np.pad(tree, 1)
    thick = ndimage.distance_transform_edt(inside)[1:-1, 1:-1] > max(1.5, STROKE_SHARE * height / 2)
    solid = ndimage.distance_transform_edt(~thick) <= max(1.5, STROKE_SHARE * height / 2)
    crown = np.arange(len(tree))[:, None] < rows[0] + 0.75 * height
    return bool((solid & tree & crown).sum() < LEAST_SOLID * max(1, (tree & crown).sum()))


def leaf_share(rgb: Rgb, tree: Region) -> float:
    """Share of the tree's pixels that have the colour of leaves, in summer or autumn."""
    return float(_leaf(rgb)[tree].mean())


def _wood(rgb: Rgb) -> Region:
    hsv = rgb2hsv(rgb)
    hue, saturation, value = hsv[..., 0], hsv[..., 1], hsv[..., 2]
    brown = (hue <= WOOD_HUES[1]) & (saturation > 0.12) & (value < 0.72)
    grey = (saturation <= 0.16) & (value < 0.85)
    return np.asarray((brown | grey) & (value > DARK))


def _leaf(rgb: Rgb) -> Region:
    hsv = rgb2hsv(rgb)
    hue, saturation, value = hsv[..., 0], hsv[..., 1], hsv[..., 2]
    green = (hue > WOOD_HUES[1]) & (hue < GREEN_HUES[1]) & (saturation > 0.16)
    autumn = (hue <= GREEN_HUES[0]) & (saturation > 0.5) & (value >= 0.72)
    return np.asarray((green | autumn) & (value > 0.08))


def _without_specks(wood: Region, tree: Region) -> Region:
    """Wood without the brownish pixels that smoothed outlines leave."""
    labels, _ = ndimage.label(wood)
    areas = np.bincount(labels.ravel())
    areas[0] = 0
    return np.asarray(np.isin(labels, np.flatnonzero(areas > SPECK_SHARE * tree.sum())))


def _held(wood: Region, tree: Region) -> Region:
    """Wood that hangs together with the trunk: brown alone never makes a branch."""
    column = _woody_rows(trunk_column(tree), wood)
    foot = column if column.any() else _lowest_quarter(tree)
    labels, _ = ndimage.label(wood | column, structure=np.ones((3, 3)))
    keep = np.unique(labels[foot & (wood | column)])
    held = np.isin(labels, keep[keep > 0])
    return np.asarray(held & (wood | column))


def _woody_rows(column: Region, wood: Region) -> Region:
    """Rows of `column` that are mostly wood: its top may reach into the leaves."""
    share = (column & wood).sum(axis=1) / np.maximum(column.sum(axis=1), 1)
    return np.asarray(column & (share > 0.5)[:, None])


def _lowest_quarter(tree: Region) -> Region:
    rows = np.flatnonzero(tree.any(axis=1))
    low = rows[-1] - (rows[-1] - rows[0]) // 4
    return np.asarray(tree & (np.arange(len(tree))[:, None] > low))
