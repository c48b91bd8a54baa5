"""The fast view ranks the plants of every generator as a slow and exact one at 512 rows does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.fidelity import BEST_HALF, GATE_ROWS, PIXELS, SPEARMAN, missed, parts
from experiments.view_fidelity import Agreement, look, measure, random_plants
from tests.conftest import blob
from tests.generators.test_contract import GENERATORS
from treefit.mask import Mask
from treefit.plant import Plant
from treefit.similarity import Mix, PaperSimilarity
from treefit.view import BitMask, Frame, OrthographicView

PLANTS = 120
NOISE = 0.005
"""Of a correlation. At so few rows even the exact view misses the gates where plants are thin and bare."""
UNCUT = [name for name in GENERATORS if name != "weberpenn_full"]
"""Of the random plants of the other one nearly all are cut."""


@pytest.mark.slow
@pytest.mark.parametrize("name", UNCUT)
def test_scores_and_pixels_are_those_of_an_exact_view(name: str, pictures: list[Mask]) -> None:
    similarities = {"paper": PaperSimilarity(), "treefit": Mix()}
    both = measure(GENERATORS[name], OrthographicView(), similarities, pictures, PLANTS, [GATE_ROWS], 0)
    assert len(both) == 2
    for found in both:
        assert found.spearman >= min(SPEARMAN, found.spearman_limit - NOISE)
        assert found.best_half >= min(BEST_HALF, found.best_half_limit - NOISE)
        near = pytest.approx(1, abs=PIXELS)
        assert found.branch_pixels / found.branch_pixels_limit == near
        assert found.foliage_pixels / found.foliage_pixels_limit == near


def test_a_view_that_thickens_what_it_draws_does_not_pass(pictures: list[Mask]) -> None:
    def thick(plant: Plant, frame: Frame) -> BitMask:
        bits = OrthographicView()(plant, frame)
        branch = bits.branch | bits.branch << np.uint64(1)
        return BitMask(branch, (bits.foliage | bits.foliage << np.uint64(1)) & ~branch)

    view = type("Thick", (), {"__call__": lambda self, plant, frame: thick(plant, frame)})()
    found = measure(GENERATORS["simplegen"], view, parts(PaperSimilarity()), pictures[:1], 60, [GATE_ROWS], 0)
    assert {"branch", "foliage"} <= {line.split()[0] for line in missed(found)}


def test_missed_gates_are_told_and_only_those() -> None:
    good = Agreement(GATE_ROWS, "whole", 0.98, 0.9, 0.94, 0.8, 0.99, 0.95, 1.01, 0.99, 1.0, 1.0, 1.2, 1.2)
    assert missed([good, replace(good, rows=64, spearman=0.1), replace(good, similarity="texture", spearman=0.1)]) == []
    assert missed([replace(good, best_half=0.9)]) == ["best half 0.900 < 0.93 (the naive view reaches 0.950)"]
    assert missed([replace(good, foliage_pixels=1.03)]) == [
        "foliage pixels 1.030 not within 0.02 of 1 (the naive view reaches 1.000)"
    ]


def test_the_same_plant_scores_one_and_its_pixels_are_counted() -> None:
    plants = random_plants(GENERATORS["simplegen"], 3)
    plant, frame = next(plants), Frame(128, 4)
    own = OrthographicView()(plant, frame).unpack()
    seen = look(OrthographicView(), frame, [plant], [blob(512, 512)], parts(PaperSimilarity()))
    assert seen.pixels[0] * 128**2 == pytest.approx([(own == 1).sum(), (own == 2).sum()])
    assert 0 < seen.scores["whole"][0, 0] < 1
