"""One tree: of all that looks like a tree, the part in the middle with the twigs and leaves that hang beside it."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from treefit.image.picture import Region

ASIDE = 0.25
"""Deviation, in widths of the picture, by which parts aside of the middle count less."""

NEAR, LESSER = 0.03, 0.2
"""Distance in heights of the tree, and share of its pixels, up to which another part is a tuft of it."""

TOUCHING = np.ones((3, 3))


def one_tree(tree: Region) -> Region:
    """(h, w) bool: the connected part of `tree` with most pixels near the middle column, and its loose tufts."""
    labels, count = ndimage.label(tree, structure=TOUCHING)
    if count <= 1:
        return tree
    columns = (np.arange(tree.shape[1]) + 0.5) / tree.shape[1]
    weight = np.broadcast_to(np.exp(-(((columns - 0.5) / ASIDE) ** 2)), tree.shape)
    parts = np.arange(1, count + 1)
    main = 1 + int(np.argmax(ndimage.sum_labels(weight, labels, parts)))
    rows = np.flatnonzero((labels == main).any(axis=1))
    reach = NEAR * (rows[-1] - rows[0] + 1)
    near = np.unique(labels[ndimage.distance_transform_edt(labels != main) <= reach])
    areas = np.bincount(labels.ravel())
    tufts = [part for part in near if part > 0 and areas[part] <= LESSER * areas[main]]
    return np.asarray(np.isin(labels, [main, *tufts]))
