"""Proposals for a drawing: several extractors cut it out, and what a network believes of it says which is right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from treefit.image.belief import Belief, expected_overlap, finer
from treefit.image.extraction import Extraction, Extractor
from treefit.image.kinds import kinds
from treefit.image.network import NetworkMask
from treefit.image.picture import Picture, shrink
from treefit.image.read import NoTreeError
from treefit.image.resize import resize_mask
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

SIZE = 512
EXACT = 0.03
"""A cut along drawn edges may overlap so much less with the belief than the network's own cut, which is never exact."""


def best_of(picture: Picture, ways: Sequence[Extractor], network: NetworkMask) -> Extraction:
    """Of what `ways` and `network` find in the drawing `picture`, that which `network` expects to overlap most.

    The region is that of the chosen way; in it the network tells branch from foliage, for ink has no hue.
    """
    look = shrink(picture, SIZE)
    seen = network.belief(picture)
    belief = finer(seen, look.rgb, network.edge)
    found = list(_found(picture, ways))
    try:
        found.append(network.judged(picture, seen))
    except NoTreeError:
        if not found:
            raise
    judged = [(_expected(belief, one) + EXACT * (one.method != "network"), one) for one in found]
    worth, best = max(judged, key=lambda pair: pair[0])
    if best.method == "network":
        return best
    return replace(best, mask=_told_apart(best, look, belief), confidence=min(worth, 1.0))


def _found(picture: Picture, ways: Sequence[Extractor]) -> Iterator[Extraction]:
    for way in ways:
        try:
            yield way(picture)
        except NoTreeError:
            continue


def _expected(belief: Belief, found: Extraction) -> float:
    return expected_overlap(belief, resize_mask(found.mask, belief.shape[:2]))


def _told_apart(found: Extraction, look: Picture, belief: Belief) -> Mask:
    """Mask of the region that was `found`, in which `belief` tells branch from foliage."""
    tree = resize_mask(found.mask, look.shape) != BACKGROUND
    wood = resize_mask(kinds(look.rgb, tree, belief), found.mask.shape) == BRANCH
    return np.where(found.mask == BACKGROUND, BACKGROUND, np.where(wood, BRANCH, FOLIAGE)).astype(np.uint8)
