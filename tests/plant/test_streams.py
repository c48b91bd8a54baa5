from __future__ import annotations

import numpy as np
from numba import njit

from treefit.plant.streams import child_key, circle, uniform


@njit
def draws(seed: int, count: int) -> np.ndarray:
    out = np.empty(count, np.float32)
    for i in range(count):
        out[i] = uniform(child_key(np.uint64(seed), i), 3)
    return out


@njit
def points(count: int) -> np.ndarray:
    out = np.empty((count, 2), np.float32)
    for i in range(count):
        out[i, 0], out[i, 1] = circle(np.float32(i / count - 1))
    return out


def test_draws_are_uniform_and_without_correlation_between_neighbours() -> None:
    sample = draws(1, 100_000)
    assert 0 <= sample.min() < sample.max() < 1
    assert np.abs(np.histogram(sample, 20, (0, 1))[0] / 5000 - 1).max() < 0.06
    assert abs(np.corrcoef(sample[:-1], sample[1:])[0, 1]) < 0.01


def test_neighbouring_seeds_give_unrelated_draws() -> None:
    assert abs(np.corrcoef(draws(1, 50_000), draws(2, 50_000))[0, 1]) < 0.02


def test_a_circle_is_closed_and_round() -> None:
    turn = np.arange(1000) / 1000
    exact = np.stack([np.cos(2 * np.pi * turn), np.sin(2 * np.pi * turn)], axis=1)
    assert np.abs(points(1000) - exact).max() <= 2 * np.pi / 1024
