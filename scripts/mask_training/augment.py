"""Views of painted scenes: framed, stretched, mirrored and coloured anew, so that one scene teaches more than once."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.nn.functional import affine_grid, avg_pool2d, grid_sample

from scripts.mask_training.rounds import Scenes
from scripts.mask_training.windows import windows

LUMINANCE = (0.299, 0.587, 0.114)


def views(scenes: Scenes, shape: tuple[int, int], rng: np.random.Generator) -> tuple[Tensor, Tensor]:
    """Pictures (n, 3, *shape) float in 0..1 and classes (n, *shape) int64, drawn by `rng`."""
    rgb = torch.from_numpy(scenes.rgb).permute(0, 3, 1, 2).float() / 255
    classes = torch.from_numpy(scenes.classes)[:, None].float()
    count = len(rgb)
    grid = affine_grid(torch.from_numpy(_maps(scenes, shape, rng)), [count, 3, *shape], align_corners=False)
    pictures = grid_sample(rgb, grid, mode="bilinear", padding_mode="reflection", align_corners=False)
    labels = grid_sample(classes, grid, mode="nearest", padding_mode="reflection", align_corners=False)
    return recoloured(pictures, rng), labels[:, 0].long()


def plain(scenes: Scenes) -> tuple[Tensor, Tensor]:
    """Pictures (n, 3, s, s) float in 0..1 and classes (n, s, s) int64 as they were painted."""
    return torch.from_numpy(scenes.rgb).permute(0, 3, 1, 2).float() / 255, torch.from_numpy(scenes.classes).long()


def _maps(scenes: Scenes, shape: tuple[int, int], rng: np.random.Generator) -> NDArray[np.float32]:
    """(n, 2, 3) affine maps from a view to its scene: a window, half of them mirrored, slightly turned."""
    middle, half = windows(scenes.classes, shape[1] / shape[0], rng)
    count = len(middle)
    mirror = np.where(rng.random(count) < 0.5, -1.0, 1.0)
    turn = rng.normal(0, 0.03, count)
    maps = np.empty((count, 2, 3), np.float32)
    maps[:, 0] = np.stack((mirror * half[:, 0], -turn * half[:, 1], middle[:, 0]), axis=1)
    maps[:, 1] = np.stack((mirror * turn * half[:, 0], half[:, 1], middle[:, 1]), axis=1)
    return maps


def recoloured(pictures: Tensor, rng: np.random.Generator) -> Tensor:
    """`pictures` (n, 3, h, w) with another light: gamma, contrast, saturation, white balance, blur and grain."""
    count = len(pictures)

    def each(low: float, high: float, channels: int = 1) -> Tensor:
        return torch.from_numpy(rng.uniform(low, high, (count, channels, 1, 1)).astype(np.float32))

    def some(share: float) -> Tensor:
        return torch.from_numpy(rng.random((count, 1, 1, 1)) < share)

    x = pictures.clamp(1e-4, 1) ** torch.exp2(each(-0.4, 0.4))
    grey = (x * torch.tensor(LUMINANCE).view(1, 3, 1, 1)).sum(dim=1, keepdim=True)
    saturation = torch.where(some(0.05), torch.zeros(1), each(0.6, 1.3))
    x = grey + (x - grey) * saturation
    x = x * each(0.8, 1.15) * torch.exp(each(-0.05, 0.05, 3)) + each(-0.05, 0.05)
    x = torch.where(some(0.15), avg_pool2d(x, 3, 1, 1, count_include_pad=False), x)
    grain = torch.from_numpy(rng.standard_normal(x.shape, dtype=np.float32))
    return (x + grain * torch.clamp(each(-0.03, 0.04), min=0)).clamp(0, 1)
