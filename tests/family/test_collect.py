"""Collecting: the family scores a plant as fits would, and counts and thresholds are those done by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.failing import Failing
from treefit.family.batch import Batch, genes, grow_batch, keep_batch, kept_batch
from treefit.family.collect import count, digest_of, good_plants, move, statistics_of, thresholds, total
from treefit.family.features import features
from treefit.family.identity import FamilyError
from treefit.family.members import Members, Seen
from treefit.objective import Objective
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Mix
from treefit.view import OrthographicView

MASKS = [blob(64, 64), blob(64, 64, crown=0.2), blob(64, 128, crown=0.6)]
WISHES = [Characteristics(vertices=400), Characteristics(vertices=40), Characteristics(vertices=None)]


def members(generator: Generator | None = None) -> Members:
    return Members.of(MASKS, WISHES, generator or SimpleGen(), OrthographicView(resolution=64), Mix())


@pytest.fixture(scope="module")
def batches() -> list[Batch]:
    return [grow_batch(members(), 40, (0, 0, i)) for i in range(2)]


def test_a_plant_scores_for_every_target_what_it_would_score_in_a_fit(batches: list[Batch]) -> None:
    family = members()
    fits = [Objective(family.generator, family.space, family.view, family.frame, family.similarity, target, wish, 0,
                      wish.budget) for target, wish in zip(family.targets, family.wishes, strict=True)]  # fmt: skip
    batch = batches[0]
    for genome, seed, scores in zip(genes(batch.genomes), batch.seeds, batch.scores, strict=True):
        np.testing.assert_allclose(scores, [fit.on(int(seed))(genome).total for fit in fits], rtol=1e-6)
    assert (batch.scores[:, 1] == 0).sum() > (batch.scores[:, 2] == 0).sum()  # over the budget of one target alone


def test_the_frame_is_wide_enough_for_every_target_and_the_size_is_a_gene_when_a_wish_sees_it() -> None:
    assert members().frame.half_width >= 1.5 * 0.6
    sized = [replace(wish, height=10.0) for wish in WISHES]
    family = Members.of(MASKS, sized, SimpleGen(), OrthographicView(resolution=64), Mix())
    assert "branch_len_0" in family.space.names


def test_a_batch_is_the_same_again_and_keeps_plants_features_and_counts(batches: list[Batch]) -> None:
    again = grow_batch(members(), 40, (0, 0, 1))
    for name, array in vars(again).items():
        assert array.tobytes() == getattr(batches[1], name).tobytes()
    family = members()
    plant = family.generator(family.space.decode(genes(again.genomes)[3]), int(again.seeds[3]), family.budget)
    assert again.usable[3]
    assert (plant.n_vertices, plant.n_leaves) == (again.vertices[3], again.leaves[3])
    np.testing.assert_array_equal(again.features[3], features(family.view(plant, family.frame)).astype(np.float16))


def test_plants_that_fail_score_nothing_and_are_not_usable() -> None:
    family = members(Failing(share=0.5))
    batch = grow_batch(family, 20, (1,))
    assert 0 < batch.usable.sum() < 20
    assert not batch.scores[~batch.usable].any()


def test_a_batch_that_is_kept_is_taken_and_a_short_or_damaged_one_grown_anew(
    tmp_path: Path, batches: list[Batch]
) -> None:
    path = tmp_path / "pairs_0000.npz"
    assert kept_batch(path, 40, "a") is None
    keep_batch(path, batches[0], "a")
    kept = kept_batch(path, 40, "a")
    assert kept is not None
    assert all((array == getattr(batches[0], name)).all() for name, array in vars(kept).items())
    assert kept_batch(path, 41, "a") is None
    with pytest.raises(FamilyError, match="is of another collection"):
        kept_batch(path, 40, "b")
    path.write_bytes(path.read_bytes()[:1000])
    assert kept_batch(path, 40, "a") is None


def test_a_collection_is_another_one_with_another_mask_seed_wish_or_similarity() -> None:
    family, moved = members(), [*MASKS[:2], np.roll(MASKS[2], 3, axis=1)]
    other_wish = replace(family, wishes=(*family.wishes[:2], Characteristics(vertices=9)))
    other_likeness = replace(family, similarity=Mix(combine="product"))
    found = {digest_of(family, MASKS, 0), digest_of(family, MASKS, 1), digest_of(family, moved, 0)}
    found |= {digest_of(other_wish, MASKS, 0), digest_of(other_likeness, MASKS, 0)}
    assert len(found) == 5
    assert digest_of(members(), MASKS, 0) in found


def test_a_share_of_the_plants_is_over_the_threshold_of_each_target_unless_a_score_is_given(
    batches: list[Batch],
) -> None:
    eps = thresholds(batches, 0.25, None)
    over = np.mean(np.concatenate([batch.scores for batch in batches]) > eps, axis=0)
    np.testing.assert_allclose(over[[0, 2]], 0.25)
    assert over[1] < 0.25  # most plants are over the budget of this target and score the same
    np.testing.assert_array_equal(thresholds(batches, 0.25, 0.001), np.full(3, 0.001))


def test_counts_are_those_of_going_through_all_evaluations_one_by_one(batches: list[Batch]) -> None:
    eps, parts = thresholds(batches, 0.2, None), 4
    tried, above = count(batches, eps, parts)
    slow = np.zeros((2, *tried.shape), np.int64)
    for batch in batches:
        for genome, scores in zip(genes(batch.genomes), batch.scores, strict=True):
            for i, gene in enumerate(genome):
                slow[0, i, int(gene * parts)] += len(scores)
                slow[1, i, int(gene * parts)] += sum(scores > eps)
    np.testing.assert_array_equal([tried, above], slow)
    assert tried.dtype == above.dtype == np.int64


class Slope:
    """A family of two functions: that of the first target rises by k in gene k, that of the second is never good."""

    generator, similarity, space = SimpleGen(), Mix(), SimpleGen().space

    def __call__(self, genome: np.ndarray, seed: int) -> Seen:
        return Seen(np.array([genome @ np.arange(len(genome)), -1.0], np.float32))


def test_the_rate_of_a_gene_is_the_slope_of_the_score_for_the_targets_that_a_plant_is_good_for() -> None:
    family: Any = Slope()
    batch = grow_batch(family, 8, (0,))
    eps = np.array([0.0, 0.0])
    chosen = good_plants([batch], eps, 5, 0)
    moved = [move(family, batch.genomes[row], 0, batch.scores[row], eps, (0, int(row))) for _, row in chosen]
    n = batch.genomes.shape[1]
    np.testing.assert_allclose(total(moved).change / 5, np.arange(n), atol=2e-2)
    found = statistics_of(family, [batch], eps, 10, moved)
    np.testing.assert_allclose(found.rate, np.arange(n), atol=2e-2)
    assert (found.steps == 5).all()


def test_good_plants_are_over_eps_for_a_target_and_drawn_without_repeats(batches: list[Batch]) -> None:
    eps = thresholds(batches, 0.1, None)
    chosen = good_plants(batches, eps, 1000, 0)
    assert len({tuple(pair) for pair in chosen.tolist()}) == len(chosen)
    assert sum(int((batch.scores > eps).any(axis=1).sum()) for batch in batches) == len(chosen)
    assert all((batches[i].scores[row] > eps).any() for i, row in chosen)
    assert len(good_plants(batches, eps, 3, 0)) == 3
