"""What the network is trained to make small: cross-entropy and Dice loss."""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn.functional import cross_entropy, one_hot


def mask_loss(logits: Tensor, classes: Tensor, branch_weight: float) -> Tensor:
    """Weighted cross-entropy + (1 - mean Dice coefficient over the classes, of the whole batch).

    `logits` (n, 3, h, w), `classes` (n, h, w) int64. Dice (Milletari et al. 2016, "V-Net") counts a thin trunk as
    much as a large crown.
    """
    logits = logits.float()
    entropy = cross_entropy(logits, classes, torch.tensor([1.0, branch_weight, 1.0]))
    guess = torch.softmax(logits, dim=1)
    truth = one_hot(classes, 3).permute(0, 3, 1, 2).float()
    both = (guess * truth).sum(dim=(0, 2, 3))
    each = guess.sum(dim=(0, 2, 3)) + truth.sum(dim=(0, 2, 3))
    return entropy + 1 - ((2 * both + 1) / (each + 1)).mean()
