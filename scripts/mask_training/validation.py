"""How good the network is on scenes that it was not trained on: losses, IoU, and pictures to look at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from PIL import Image
from torch import nn

from scripts.mask_training.augment import plain
from scripts.mask_training.loss import mask_loss
from scripts.mask_training.rounds import Scenes
from treefit.image.overlay import overlay
from treefit.image.picture import Picture
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE

SHOWN = 12
NAMES = {"background": BACKGROUND, "branch": BRANCH, "foliage": FOLIAGE}


def validate(network: nn.Module, scenes: Scenes, folder: Path) -> dict[str, float]:
    """Loss and IoU by class and of the whole tree over all pixels of `scenes`; writes validation.png to `folder`."""
    network.eval()
    losses, guesses = [], []
    with torch.inference_mode():
        for at in range(0, len(scenes.rgb), 8):
            pictures, classes = plain(Scenes(scenes.rgb[at : at + 8], scenes.classes[at : at + 8]))
            logits = network(pictures)
            losses.append(float(mask_loss(logits, classes, 1.0)) * len(pictures))
            guesses.append(logits.argmax(dim=1).numpy().astype(np.uint8))
    guess = np.concatenate(guesses)
    sheet(scenes, guess).save(folder / "validation.png", optimize=True)
    scores = {f"iou_{name}": iou(guess == index, scenes.classes == index) for name, index in NAMES.items()}
    tree = iou(guess != BACKGROUND, scenes.classes != BACKGROUND)
    return {"loss": sum(losses) / len(scenes.rgb), **scores, "iou_tree": tree}


def iou(found: NDArray[np.bool_], expected: NDArray[np.bool_]) -> float:
    """Intersection over union, 1 when both are empty."""
    union = (found | expected).sum()
    return float((found & expected).sum() / union) if union else 1.0


def sheet(scenes: Scenes, guess: NDArray[np.uint8]) -> Image.Image:
    """Rows of two scenes: picture, truth and guess of each, as overlays."""
    rows = []
    for rgb, truth, found in zip(scenes.rgb[:SHOWN], scenes.classes, guess, strict=False):
        rows.append(np.concatenate([rgb, overlay(Picture(rgb), truth), overlay(Picture(rgb), found)], axis=1))
    if len(rows) % 2:
        rows.append(np.full_like(rows[0], 255))
    return Image.fromarray(np.concatenate([np.concatenate(rows[k : k + 2], axis=1) for k in range(0, len(rows), 2)]))
