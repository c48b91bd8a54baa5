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


def test_scores_at_or_under_the_floor_of_before_make_no_difference() -> None:
    """Not even when one of the batch takes the place of several and makes room."""
    rng, exact, rough = np.random.default_rng(1), *(Archive(2, capacity=6, distance=0.3) for _ in range(2))
    made_room = 0
    for _ in range(300):
        genomes = rng.random((8, 2))
        scores = genomes.sum(axis=1) + 0.2 * rng.random(8)
        exact.add(genomes, scores)
        rough.add(genomes, np.where(scores <= rough.floor, 0.0, scores))
        made_room += 0 < len(exact.scores) < 6
        assert exact.genomes.tobytes() == rough.genomes.tobytes()
        assert exact.scores.tobytes() == rough.scores.tobytes()
    assert made_room > 10


def test_the_floor_is_zero_while_there_is_room() -> None:
    archive = Archive(1, capacity=2, distance=0.1)
    archive.add(np.array([[0.1]]), np.array([0.5]))
    assert archive.floor == 0
    archive.add(np.array([[0.9]]), np.array([0.7]))
    assert archive.floor == 0.5


def test_a_score_of_zero_is_never_kept() -> None:
    archive = Archive(2)
    archive.add(np.random.default_rng(0).random((9, 2)), np.zeros(9))
    assert len(archive.best(3)[0]) == 0
