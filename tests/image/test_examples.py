from functools import cache
from pathlib import Path

import numpy as np
import pytest

from treefit.image.auto import AutoMask
from treefit.image.extraction import Extraction
from treefit.image.read import read_picture
from treefit.mask import BRANCH, FOLIAGE

EXAMPLES = Path(__file__).parents[2] / "experiments" / "images"


@cache
def extraction(name: str) -> Extraction:
    return AutoMask()(read_picture(EXAMPLES / f"{name}.png"))


@pytest.mark.parametrize(
    ("name", "method", "foliage", "branch"),
    [
        ("pine", "network", (0.20, 0.27), (0.003, 0.02)),
        ("oak", "network", (0.28, 0.40), (0.012, 0.05)),
        ("cutout", "alpha", (0.20, 0.32), (0.012, 0.04)),
        ("silhouette", "network", (0.17, 0.30), (0.015, 0.05)),
        ("sketch", "sketch", (0.33, 0.45), (0.015, 0.04)),
    ],
)
def test_auto_chooses_the_method_and_finds_the_tree(
    name: str, method: str, foliage: tuple[float, float], branch: tuple[float, float]
) -> None:
    found = extraction(name)
    assert found.method == method
    assert found.warnings == ()
    assert foliage[0] < (found.mask == FOLIAGE).mean() < foliage[1]
    assert branch[0] < (found.mask == BRANCH).mean() < branch[1]


@pytest.mark.parametrize("name", ["pine", "oak", "cutout", "silhouette", "sketch"])
def test_the_trunk_stands_under_the_middle_of_the_crown(name: str) -> None:
    mask = extraction(name).mask
    width = mask.shape[1]
    branch_rows, branch_columns = np.nonzero(mask == BRANCH)
    foliage_rows, foliage_columns = np.nonzero(mask == FOLIAGE)
    assert branch_rows.max() > np.percentile(foliage_rows, 99)
    assert np.median(branch_rows) > np.median(foliage_rows)
    assert abs(np.median(branch_columns) - np.median(foliage_columns)) < 0.08 * width
    assert abs(np.median(foliage_columns) - width / 2) < 0.1 * width


def test_the_pine_is_a_cone() -> None:
    widths = (extraction("pine").mask == FOLIAGE).sum(axis=1)
    rows = np.flatnonzero(widths)
    thirds = [widths[part].mean() for part in np.array_split(rows, 3)]
    assert thirds[0] < 0.6 * thirds[1] < 0.6 * thirds[2]


def test_the_same_picture_gives_the_same_mask_twice() -> None:
    again = AutoMask()(read_picture(EXAMPLES / "pine.png"))
    assert np.array_equal(extraction("pine").mask, again.mask)
