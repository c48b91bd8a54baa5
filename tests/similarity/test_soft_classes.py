from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from treefit.mask import BRANCH, FOLIAGE
from treefit.similarity import SoftClasses
from treefit.similarity.soft_classes import SCALES, smallest_cell
from treefit.view import BitMask


def obvious(pixels: NDArray[np.bool_], cell: int) -> NDArray[np.int64]:
    """Counts in all windows, scale after scale, by sums of blocks."""
    height, width = pixels.shape
    rows = -(-height // cell)
    padded = np.zeros((rows * cell, width), int)
    padded[:height] = pixels
    cells = padded.reshape(rows, cell, width // cell, cell).sum(axis=(1, 3))
    found = []
    for _ in range(SCALES):
        found.append((cells[:-1, :-1] + cells[1:, :-1] + cells[:-1, 1:] + cells[1:, 1:]).ravel())
        even = np.vstack([cells, np.zeros_like(cells[: len(cells) % 2])])
        even = even[:, : even.shape[1] // 2 * 2]
        cells = even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2]
    return np.concatenate(found)


@pytest.mark.parametrize("height", [64, 100, 128, 130, 200, 256])
def test_windows_count_the_pixels_in_them(height: int) -> None:
    mask = np.random.default_rng(1).integers(0, 3, (height, 192)).astype(np.uint8)
    windows = SoftClasses().describe(BitMask.pack(mask))
    for label, counts in ((FOLIAGE, windows.counts[0]), (BRANCH, windows.counts[1])):
        assert (counts == obvious(mask == label, smallest_cell(height))).all()
    assert windows.ends[-1] == windows.counts.shape[1]


def test_branches_count_more_unless_there_are_none() -> None:
    target = np.zeros((128, 128), np.uint8)
    target[40:, 60:68], target[:80, 30:98] = BRANCH, FOLIAGE
    no_trunk = np.where(target == BRANCH, 0, target).astype(np.uint8)

    def compare(weight: float, one: NDArray[np.uint8], two: NDArray[np.uint8]) -> float:
        similarity = SoftClasses(branch_weight=weight)
        return similarity.compare(*(similarity.describe(BitMask.pack(mask)) for mask in (one, two)))

    assert compare(6.0, target, no_trunk) < compare(3.0, target, no_trunk)
    assert compare(6.0, no_trunk, target) == compare(3.0, no_trunk, target)
