"""Guided upsampling: what is known of a small picture, carried to the edges of the large one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import uniform_filter

from treefit.image.picture import Rgb

Values = NDArray[np.float32]
"""(h, w, k) float32: k numbers a pixel."""

Wide = NDArray[np.float64]  # differences of products need the digits


def upsample(values: Values, small: Rgb, large: Rgb, radius: int, smoothness: float) -> Values:
    """`values` (h, w, k) of the picture `small` at the size of `large`, with steps where its colours have them.

    In every window of 2 `radius` + 1 pixels the values are fitted as a linear function of the colour, with `smoothness`
    as ridge (colours in 0..1, squared); the functions are averaged and enlarged, not the values (He & Sun 2015, "Fast
    guided filter").
    """
    slopes, offsets = _fit(values.astype(np.float64), small / 255.0, 2 * radius + 1, smoothness)
    colours = large.astype(np.float32) / 255
    result = np.empty((*large.shape[:2], values.shape[2]), np.float32)
    for index in range(values.shape[2]):
        result[..., index] = _enlarge(offsets[..., index], large)
        for channel in range(3):
            result[..., index] += _enlarge(slopes[..., channel, index], large) * colours[..., channel]
    return np.clip(result, 0, 1)


FIRST, SECOND = [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]
WHOLE = np.array([[0, 1, 2], [1, 3, 4], [2, 4, 5]])


def _fit(values: Wide, guide: Wide, side: int, smoothness: float) -> tuple[Wide, Wide]:
    """Slopes (h, w, 3, k) and offsets (h, w, k), each averaged over the windows that a pixel is in."""

    def mean(x: Wide) -> Wide:
        return np.asarray(uniform_filter(x, (side, side) + (1,) * (x.ndim - 2), mode="nearest"))

    middle, level = mean(guide), mean(values)
    # the matrix is symmetric: six of its nine means are enough
    squares = mean(guide[..., FIRST] * guide[..., SECOND]) - middle[..., FIRST] * middle[..., SECOND]
    spread = squares[..., WHOLE]
    together = mean(guide[..., :, None] * values[..., None, :]) - middle[..., :, None] * level[..., None, :]
    slopes: Wide = np.asarray(np.linalg.solve(spread + smoothness * np.eye(3), together))
    offsets: Wide = level - (slopes * middle[..., None]).sum(axis=-2)
    return mean(slopes), mean(offsets)


def _enlarge(values: Wide, large: Rgb) -> NDArray[np.float32]:
    image = Image.fromarray(values.astype(np.float32))
    return np.asarray(image.resize((large.shape[1], large.shape[0]), Image.Resampling.BILINEAR))
