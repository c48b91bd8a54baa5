"""Warnings: what about a mask would spoil a fit, in words a user can act on."""

from __future__ import annotations

import numpy as np
from skimage.measure import label, regionprops

from treefit.image.picture import Picture
from treefit.image.read import NoTreeError, PictureError
from treefit.mask import BACKGROUND, Mask

LEAST_SIDE = 8
LEAST_TREE = 0.005
LEAST_HEIGHT = 128
CUT_SHARE = 0.02
SECOND_TREE = 0.25
CURE = "show it with mask.point=[x,y], mask.crop=[left,top,right,bottom] or mask.outline=[[x,y],...], or give a mask"


def check_picture(picture: Picture) -> None:
    """PictureError when no extractor could find a tree in `picture`, because it is tiny or of one colour."""
    height, width = picture.shape
    if min(height, width) < LEAST_SIDE:
        raise PictureError(
            f"{_name(picture)}: {width} x {height} pixels is too small to show a tree; give a larger one"
        )
    one_colour = (picture.rgb == picture.rgb[0, 0]).all()
    if one_colour and (picture.alpha is None or (picture.alpha == picture.alpha[0, 0]).all()):
        raise PictureError(f"{_name(picture)}: the picture is of one colour, there is no tree in it; {CURE}")


def judge(mask: Mask) -> tuple[str, ...]:
    """Warnings about `mask`, most harmful first; NoTreeError when there is no tree in it at all."""
    tree = mask != BACKGROUND
    share = float(tree.mean())
    if share == 0.0:
        raise NoTreeError(f"no tree was found in the picture; {CURE}")
    found = []
    if share < LEAST_TREE:
        found.append(f"almost no tree: {share:.2%} of the pixels; {CURE}")
    found += _cut(tree)
    found += _several(tree)
    rows = np.flatnonzero(tree.any(axis=1))
    height = int(rows[-1] - rows[0] + 1)
    if height < LEAST_HEIGHT:
        found.append(f"the tree is only {height} pixels high: below {LEAST_HEIGHT} its outline is coarse")
    return tuple(found)


def _cut(tree: np.ndarray) -> list[str]:
    """The bottom is left out: a trunk may well leave the picture there."""
    borders = {"top": tree[0], "left": tree[:, 0], "right": tree[:, -1]}
    touching = [name for name, border in borders.items() if border.mean() > CUT_SHARE]
    return [f"the tree is cut off at the {' and '.join(touching)} of the picture"] if touching else []


def _several(tree: np.ndarray) -> list[str]:
    areas = sorted((region.area for region in regionprops(label(tree, connectivity=2))), reverse=True)
    large = sum(area > SECOND_TREE * areas[0] for area in areas)
    return [f"{large} separate parts of like size, perhaps several trees; {CURE}"] if large > 1 else []


def _name(picture: Picture) -> str:
    return "the picture" if picture.path is None else str(picture.path)
