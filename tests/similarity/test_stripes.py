from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from treefit.mask import Mask
from treefit.similarity import stripes
from treefit.view import BitMask


def obvious(mask: Mask, count: int) -> NDArray[np.float64]:
    """Rows a, d, b, c, B, L by the definition of the paper, pixel by pixel."""
    height, width = mask.shape
    rows = []
    for s in range(count):
        band = mask[s * height // count : (s + 1) * height // count]
        columns = np.flatnonzero((band > 0).any(axis=0))
        if len(columns) == 0:
            rows.append([0.0] * 6)
            continue
        a, d = columns[0], columns[-1] + 1
        b, c = longest((band == 2).sum(axis=0) > 0.75 * len(band)) or ((a + d) / 2, (a + d) / 2)
        edges = [(x - width / 2) / height for x in (a, d, b, c)]
        area = len(band) * (d - a)
        rows.append([*edges, (band == 1).sum() / area, (band == 2).sum() / area])
    return np.array(rows)


def longest(columns: NDArray[np.bool_]) -> tuple[int, int] | None:
    best, start = None, 0
    for i in range(len(columns) + 1):
        if i < len(columns) and columns[i]:
            continue
        if i > start and (best is None or i - start > best[1] - best[0]):
            best = (start, i)
        start = i + 1
    return best


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 3), st.sampled_from([16, 64, 128, 200]), st.sampled_from([1, 7, 16]))
def test_stripes_are_those_of_the_definition(seed: int, words: int, height: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    mask = np.zeros((height, words * 64), np.uint8)
    for _ in range(rng.integers(0, 6)):
        top, left = rng.integers(0, height), rng.integers(0, words * 64)
        mask[top : top + rng.integers(1, height), left : left + rng.integers(1, 64)] = rng.integers(0, 3)
    mask[rng.random(mask.shape) < rng.choice([0, 0.1])] = rng.integers(0, 3)
    found = stripes(BitMask.pack(mask), count)
    table = np.column_stack([found.crown, found.dense, found.branch, found.foliage])
    np.testing.assert_allclose(table, obvious(mask, count), atol=1e-5)


def test_more_stripes_than_rows_are_refused() -> None:
    with pytest.raises(ValueError, match=r"count must be in \[1, 16\]"):
        stripes(BitMask.pack(np.zeros((16, 64), np.uint8)), 17)
