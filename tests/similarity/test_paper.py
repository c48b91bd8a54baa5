from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from tests.conftest import blob
from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Plant
from treefit.similarity import PaperSimilarity
from treefit.view import BitMask, Frame, OrthographicView

SIMILARITY = PaperSimilarity()


def compare(one: Mask, two: Mask) -> float:
    return SIMILARITY.compare(*(SIMILARITY.describe(BitMask.pack(mask)) for mask in (one, two)))


def test_a_mask_is_exactly_like_itself(plants: list[Plant]) -> None:
    for height in (64, 96, 128, 200, 256):
        for plant in plants:
            mask = OrthographicView()(plant, Frame(height, 5)).unpack()
            assert compare(mask, mask) == 1.0


def test_similarity_stays_between_zero_and_one(plants: list[Plant]) -> None:
    masks = [OrthographicView()(plant, Frame(128, 4)).unpack() for plant in plants]
    values = [compare(one, two) for one in masks for two in masks]
    assert 0 <= min(values) < max(values) == 1.0


def test_mirrored_pairs_are_as_similar(plants: list[Plant]) -> None:
    one, two = (OrthographicView()(plant, Frame(128, 4)).unpack() for plant in plants[:2])
    assert compare(one, two) == pytest.approx(
        compare(one[:, ::-1].copy(), two[:, ::-1].copy()), abs=1e-3
    )  # ties of the longest run


@pytest.mark.parametrize(
    "steps",
    [
        [blob(crown=crown) for crown in (0.3, 0.34, 0.38, 0.42, 0.46)],
        [blob(crown=crown) for crown in (0.3, 0.26, 0.22, 0.18)],
        [blob(bare=bare) for bare in (0.2, 0.26, 0.32, 0.38)],
        [blob(trunk=trunk) for trunk in (0.03, 0.05, 0.07, 0.09)],
    ],
    ids=["widened", "narrowed", "raised", "thicker trunk"],
)
def test_similarity_falls_with_every_step_away(steps: list[Mask]) -> None:
    values = [compare(steps[0], step) for step in steps]
    assert all(later < earlier for earlier, later in pairwise(values))


def test_similarity_falls_when_the_crown_is_thinned() -> None:
    full = blob()
    noise = np.random.default_rng(0).random(full.shape)
    values = [compare(full, np.where((full == FOLIAGE) & (noise < share), 0, full).astype(np.uint8))
              for share in (0.0, 0.1, 0.2, 0.4, 0.6)]  # fmt: skip
    assert all(later < earlier for earlier, later in pairwise(values))


def test_a_tree_without_trunk_can_score_one_and_nothing_scores_nothing() -> None:
    crown = np.where(blob() == BRANCH, 0, blob()).astype(np.uint8)
    assert compare(crown, crown) == 1.0
    assert compare(crown, np.zeros_like(crown)) == 0.0
