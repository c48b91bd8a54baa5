"""UNet: the network that tells tree from background; knows nothing of scenes, training or files."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn.functional import interpolate, max_pool2d, pixel_shuffle

LEVELS = (1, 2, 4, 6, 6, 6)
SEPARABLE_FROM = 3
DIVISOR = 2 ** len(LEVELS)
"""Height and width of the pictures are multiples of this."""


class UNet(nn.Module):
    """Pictures (n, 3, h, w) in 0..1 -> logits (n, classes, h, w).

    The first convolution halves the picture and the last doubles it (sub-pixel convolution, Shi et al. 2016, "Real-time
    single image super-resolution"): all between costs a quarter. Six levels see the whole of a picture of 256 pixels,
    which tells the tree in the middle from its neighbours. The lower levels are depthwise separable: most
    parameters would be there. `width` is the channels of the first level.
    """

    mean: Tensor
    deviation: Tensor

    def __init__(self, width: int = 24, classes: int = 3) -> None:
        super().__init__()
        channels = [width * factor for factor in LEVELS]
        self.stem = _unit(3, channels[0], stride=2)
        self.down = nn.ModuleList(
            _level(channels[max(k - 1, 0)], channels[k], separable=k >= SEPARABLE_FROM) for k in range(len(LEVELS))
        )
        self.up = nn.ModuleList(
            _level(channels[k] + channels[k + 1], channels[k], separable=k >= SEPARABLE_FROM)
            for k in range(len(LEVELS) - 1)
        )
        self.head = nn.Conv2d(channels[0], 4 * classes, 3, padding=1)
        self.register_buffer("mean", torch.tensor([0.485, 0.456, 0.406]).view(1, 3, 1, 1))
        self.register_buffer("deviation", torch.tensor([0.229, 0.224, 0.225]).view(1, 3, 1, 1))

    def forward(self, pictures: Tensor) -> Tensor:
        """Logits (n, classes, h, w)."""
        x = self.stem((pictures - self.mean) / self.deviation)
        levels = []
        for index, level in enumerate(self.down):
            x = level(x if index == 0 else max_pool2d(x, 2))
            levels.append(x)
        for index in reversed(range(len(self.up))):
            x = interpolate(x, scale_factor=2, mode="bilinear", align_corners=False)
            x = self.up[index](torch.cat((levels[index], x), dim=1))
        return pixel_shuffle(self.head(x), 2)


def _level(inputs: int, outputs: int, separable: bool) -> nn.Module:
    if separable:
        return nn.Sequential(*_separable(inputs, outputs), *_separable(outputs, outputs))
    return nn.Sequential(_unit(inputs, outputs), _unit(outputs, outputs))


def _separable(inputs: int, outputs: int) -> tuple[nn.Module, nn.Module]:
    return _unit(inputs, inputs, groups=inputs), _unit(inputs, outputs, side=1)


def _unit(inputs: int, outputs: int, side: int = 3, stride: int = 1, groups: int = 1) -> nn.Sequential:
    convolution = nn.Conv2d(inputs, outputs, side, stride, padding=side // 2, groups=groups, bias=False)
    return nn.Sequential(convolution, nn.BatchNorm2d(outputs), nn.ReLU(inplace=True))
