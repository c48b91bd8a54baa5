"""Scene: a painted picture of a tree with its classes, from a seed and a number alone; the network learns from them."""

from __future__ import annotations

import numpy as np

from scripts.mask_training.scenery.arrays import Classes, Image, Rng, chance
from scripts.mask_training.scenery.camera import photographed, written
from scripts.mask_training.scenery.drawings import clip_art, sketch
from scripts.mask_training.scenery.outdoors import outdoors
from scripts.mask_training.scenery.studies import brushed, cut_out, ink_drawing, silhouette, wash
from treefit.image.picture import Rgb
from treefit.mask import Mask

KINDS = {
    "photograph": 0.81, "painting": 0.02, "cut-out": 0.03, "silhouette": 0.03, "clip-art": 0.04, "sketch": 0.035,
    "ink": 0.015, "wash": 0.02,
}  # fmt: skip
"""Share of each kind of picture."""

TRIES = 4
LEAST, MOST = 0.04, 0.85
"""Share of the picture that a tree has; others are painted anew."""


def scene(seed: int, index: int, size: int = 192) -> tuple[Rgb, Mask]:
    """Picture (size, size, 3) and its classes (size, size); the same numbers give the same bytes."""
    for attempt in range(TRIES):
        rng = np.random.default_rng([seed, index, 1 + attempt])
        rgb, classes = _finished(kind_of(seed, index), size, rng)
        if LEAST <= float((classes > 0).mean()) <= MOST:
            break
    return rgb, classes


def kind_of(seed: int, index: int) -> str:
    """Which of KINDS the scene is."""
    return str(np.random.default_rng([seed, index]).choice(list(KINDS), p=list(KINDS.values())))


def _finished(kind: str, size: int, rng: Rng) -> tuple[Rgb, Mask]:
    picture, classes = _painted(kind, size, rng)
    if kind in ("photograph", "painting"):
        return photographed(picture, rng), classes
    if chance(rng, 0.15):  # a drawing that was photographed
        return photographed(picture, rng), classes
    return written(picture, rng), classes


def _painted(kind: str, size: int, rng: Rng) -> tuple[Image, Classes]:
    if kind == "photograph":
        return outdoors(size, rng)
    if kind == "painting":
        picture, classes = outdoors(size, rng)
        return brushed(picture, rng), classes
    paint = {
        "cut-out": cut_out, "silhouette": silhouette, "clip-art": clip_art, "sketch": sketch,
        "ink": ink_drawing, "wash": wash,
    }[kind]  # fmt: skip
    return paint(size, rng)
