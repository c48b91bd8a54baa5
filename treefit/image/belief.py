"""Belief: how likely each pixel is background, branch and foliage; what comes between a network and a mask."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.special import expit, softmax

from treefit.image.guided import upsample
from treefit.image.onnx_model import Channels
from treefit.image.picture import Rgb
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

Belief = NDArray[np.float32]
"""(h, w, 3) float32: probability of background, branch, foliage in each pixel; they add up to 1."""

PLACES = {"background": BACKGROUND, "branch": BRANCH, "foliage": FOLIAGE, "tree": FOLIAGE}
SMOOTHNESS = 1e-4


def believe(channels: Channels, names: Sequence[str]) -> Belief:
    """Belief from `channels` (c, h, w) of what `names` (c) say, logits or probabilities; equal names are added up.

    A single channel is the tree, or what of it has the name; the rest is background.
    """
    shares = _probabilities(channels)
    belief = np.zeros((*channels.shape[1:], 3), np.float32)
    for share, name in zip(shares, names, strict=True):
        belief[..., PLACES[name]] += share
    if len(names) == 1:
        belief[..., BACKGROUND] = 1 - shares[0]
    return belief


def _probabilities(channels: Channels) -> Channels:
    """`channels` as they are when they are probabilities already, else their softmax, or sigmoid of a single one."""
    in_range = channels.min() >= -1e-3 and channels.max() <= 1 + 1e-3
    if in_range and (len(channels) == 1 or np.abs(channels.sum(axis=0) - 1).max() < 0.02):
        return np.clip(channels, 0, 1)
    return expit(channels) if len(channels) == 1 else np.asarray(softmax(channels, axis=0))


def resized(belief: Belief, shape: tuple[int, int]) -> Belief:
    """`belief` (h, w, 3) at `shape`, bilinear: blurred at edges when that is larger."""
    layers = [Image.fromarray(np.ascontiguousarray(belief[..., kind])) for kind in (BACKGROUND, BRANCH, FOLIAGE)]
    return np.stack([np.asarray(layer.resize(shape[::-1], Image.Resampling.BILINEAR)) for layer in layers], axis=-1)


def finer(belief: Belief, rgb: Rgb, radius: int) -> Belief:
    """`belief` (h, w, 3) at the size of the picture `rgb`, its edges on those of the picture within `radius` pixels."""
    small = np.asarray(Image.fromarray(rgb).resize((belief.shape[1], belief.shape[0]), Image.Resampling.BOX))
    kinds = upsample(belief[..., [BRANCH, FOLIAGE]], small, rgb, radius, SMOOTHNESS)
    tree = kinds.sum(axis=-1, keepdims=True)
    return np.concatenate((np.maximum(1 - tree, 0), kinds / np.maximum(tree, 1)), axis=-1)


def expected_overlap(belief: Belief, mask: Mask) -> float:
    """Intersection over union of the tree that `belief` expects of `mask`: right if its probabilities are."""
    tree = 1 - belief[..., BACKGROUND]
    inside = mask != BACKGROUND
    union = inside.sum() + tree[~inside].sum(dtype=np.float64)
    return float(tree[inside].sum(dtype=np.float64) / union) if union else 0.0
