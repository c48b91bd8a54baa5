from __future__ import annotations

import numpy as np
import pytest

from treefit.search.archive import Archive


def test_the_archive_is_sorted_bounded_and_apart() -> None:
    rng, archive = np.random.default_rng(0), Archive(3, capacity=10, distance=0.2)
    for _ in range(20):
        genomes = rng.random((50, 3))
        archive.add(genomes, genomes.sum(axis=1))
    genomes, scores = archive.best(10)
    assert len(genomes) == 10
    assert (np.diff(scores) <= 0).all()
    np.testing.assert_allclose(genomes.sum(axis=1), scores)
    away = np.sqrt(((genomes[:, None] - genomes[None]) ** 2).mean(axis=2)) + np.eye(10)
    assert away.min() >= 0.2


def test_a_better_neighbour_takes_the_place_of_a_worse() -> None:
    archive = Archive(2, distance=0.2)
    archive.add(np.array([[0.5, 0.5]]), np.array([0.3]))
    archive.add(np.array([[0.5, 0.55], [0.5, 0.52]]), np.array([0.4, 0.2]))
    assert archive.best(5)[1].tolist() == [pytest.approx(0.4)]


def test_a_score_of_zero_is_never_kept() -> None:
    archive = Archive(2)
    archive.add(np.random.default_rng(0).random((9, 2)), np.zeros(9))
    assert len(archive.best(3)[0]) == 0
