"""Calibration: marks that know everything, nothing, and what statistics of the same plants know."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.family.counted import statistics
from treefit.family.batch import Batch, genes
from treefit.family.calibration import Calibration, calibrate
from treefit.family.collect import count


def test_marks_that_are_the_chance_itself_are_judged_best_and_those_of_nothing_as_chance() -> None:
    rng = np.random.default_rng(0)
    good = rng.integers(0, 11, 4000).astype(float)
    knowing, blind = Calibration(good, good, 10), Calibration(rng.random(4000), good, 10)
    assert knowing.rank_correlation == pytest.approx(1)
    assert knowing.area > 0.8
    assert knowing.lift(0.05) == pytest.approx(10 / good.mean())
    assert abs(blind.rank_correlation) < 0.05
    assert blind.area == pytest.approx(0.5, abs=0.02)
    assert blind.lift(0.5) == pytest.approx(1, abs=0.1)


def test_the_curve_is_the_share_of_good_evaluations_by_mark_where_there_are_enough() -> None:
    marks = np.array([0.5] * 40 + [1.5] * 30 + [7.5])
    good = np.array([1.0] * 40 + [3.0] * 30 + [4.0])
    middle, chance, counts = Calibration(marks, good, 4).curve()
    np.testing.assert_array_equal(middle, [0.5, 1.5])
    np.testing.assert_array_equal(chance, [0.25, 0.75])
    np.testing.assert_array_equal(counts, [160, 120])


def test_without_a_good_plant_nothing_is_foretold() -> None:
    none = Calibration(np.arange(50.0), np.zeros(50), 4)
    assert (none.rank_correlation, none.area, none.lift(0.1)) == (0.0, 0.5, 1.0)


def test_marks_of_the_gene_that_makes_plants_good_foretell_fresh_ones() -> None:
    found = statistics()
    made = [_batch(seed, len(found.genes)) for seed in range(2)]
    tried, above = count(made[:1], np.array([0.5]), 10)
    found = replace(found, tried=tried, above=above, eps=np.array([0.5]))
    judged = calibrate(found, made[1:], "continuous")
    assert judged.rank_correlation > 0.5
    assert judged.area > 0.9


def _batch(seed: int, n: int) -> Batch:
    """Plants that are good when their first gene is over 0.8."""
    genomes = np.random.default_rng(seed).integers(0, 65536, (20000, n), np.uint16)
    scores = (genes(genomes)[:, :1] > 0.8).astype(np.float32)
    nothing = np.zeros(len(genomes), np.int32)
    return Batch(genomes, nothing.astype(np.int64), scores, np.zeros((len(genomes), 1), np.float16), nothing, nothing,
                 np.ones(len(genomes), bool))  # fmt: skip
