from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.similarity.drawn import tree
from treefit.mask import Mask
from treefit.plant import Plant
from treefit.similarity import (
    Asymmetry,
    ClassOverlap,
    Mix,
    PaperSimilarity,
    Similarity,
    SoftClasses,
    Texture,
    Trunk,
)
from treefit.view import BitMask, Frame, OrthographicView, sample

TERMS = (SoftClasses(), ClassOverlap(), Texture(), Trunk(), Asymmetry())
WHOLE = (PaperSimilarity(), Mix(), Mix(combine="product"))
EVERY = pytest.mark.parametrize("similarity", [*WHOLE, *TERMS], ids=repr)


def compare(similarity: Similarity[Any], one: Mask, two: Mask) -> float:
    return similarity.compare(*(similarity.describe(BitMask.pack(mask)) for mask in (one, two)))


def seen(mask: Mask, height: int = 128) -> Mask:
    return sample(mask, Frame(height, 4))


@EVERY
@pytest.mark.parametrize("height", [64, 100, 128, 256])
def test_a_mask_is_exactly_like_itself(similarity: Similarity[Any], height: int, plants: list[Plant]) -> None:
    for plant in plants:
        mask = OrthographicView()(plant, Frame(height, 5)).unpack()
        assert compare(similarity, mask, mask) == 1.0


@EVERY
def test_similarity_stays_between_zero_and_one(similarity: Similarity[Any], plants: list[Plant]) -> None:
    masks = [OrthographicView()(plant, Frame(128, 4)).unpack() for plant in plants]
    masks += [np.zeros((128, 256), np.uint8), np.ones((128, 256), np.uint8), np.full((128, 256), 2, np.uint8)]
    values = [compare(similarity, one, two) for one in masks[:-3] for two in masks]
    assert 0 <= min(values) < max(values) <= 1


@EVERY
@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10**6), share=st.floats(0.02, 0.98))
def test_noise_has_a_similarity_too(similarity: Similarity[Any], seed: int, share: float) -> None:
    rng = np.random.default_rng(seed)
    one, two = (rng.integers(0, 3, (64, 128)).astype(np.uint8) * (rng.random((64, 128)) < share) for _ in range(2))
    one[0, 64] = two[0, 64] = 1
    assert compare(similarity, one, one) == 1.0
    assert 0 <= compare(similarity, one, two) <= 1


@EVERY
def test_mirrored_pairs_are_as_similar(similarity: Similarity[Any], plants: list[Plant]) -> None:
    masks = [OrthographicView()(plant, Frame(128, 4)).unpack() for plant in plants[:4]]
    for one, two in pairwise(masks):
        mirrored = compare(similarity, one[:, ::-1].copy(), two[:, ::-1].copy())
        assert mirrored == pytest.approx(compare(similarity, one, two), abs=1e-3)  # ties of the longest dense run


STEPS = {
    "widened": [{"width": 0.30 * (1 + step)} for step in (0.0, 0.08, 0.16, 0.24, 0.32, 0.4)],
    "narrowed": [{"width": 0.30 * (1 - step)} for step in (0.0, 0.08, 0.16, 0.24, 0.32, 0.4)],
    "raised": [{"lift": step} for step in (0.0, 0.04, 0.08, 0.12, 0.16, 0.2)],
    "thinned": [{"holes": 0.1 + step} for step in (0.0, 0.08, 0.16, 0.24, 0.32, 0.4)],
    "thickened": [{"trunk": 0.02 + step} for step in (0.0, 0.01, 0.02, 0.03, 0.04, 0.05)],
    "leaning": [{"lean": step} for step in (0.0, 0.05, 0.1, 0.15, 0.2)],
}


@pytest.mark.parametrize("similarity", WHOLE, ids=repr)
@pytest.mark.parametrize("change", ["widened", "narrowed", "raised", "thinned", "thickened"])
def test_similarity_falls_with_every_step_away(similarity: Similarity[Any], change: str) -> None:
    masks = [seen(tree(**traits)) for traits in STEPS[change]]
    values = [compare(similarity, masks[0], mask) for mask in masks]
    assert values[0] == 1.0
    assert all(later < earlier for earlier, later in pairwise(values)), values


@pytest.mark.parametrize(
    ("term", "change"),
    [(Texture(), "thinned"), (Trunk(), "thickened"), (Trunk(), "raised"), (Trunk(), "leaning"),
     (SoftClasses(), "widened"), (ClassOverlap(), "raised")],
    ids=repr,
)  # fmt: skip
def test_a_term_falls_with_what_it_is_for(term: Similarity[Any], change: str) -> None:
    masks = [seen(tree(**traits)) for traits in STEPS[change]]
    values = [compare(term, masks[0], mask) for mask in masks]
    assert all(later < earlier for earlier, later in pairwise(values)), values


def test_asymmetry_tells_a_shifted_crown_from_a_wide_one() -> None:
    middle = seen(tree())
    shifted = np.roll(middle, 12, axis=1)
    assert compare(Asymmetry(), middle, shifted) < 0.8
    assert compare(Asymmetry(), middle, seen(tree(width=0.4))) > 0.95


def test_texture_does_not_mind_where_the_gaps_are() -> None:
    holes = seen(tree(holes=0.25))
    mirrored = holes[:, ::-1].copy()
    assert compare(Texture(), holes, mirrored) > 0.97
    assert compare(ClassOverlap(), holes, mirrored) < 0.9


def test_spikes_do_not_pass_for_clumps() -> None:
    clumps = seen(tree(holes=0.3))
    outline = seen(tree(holes=0.0))
    spikes = outline.copy()
    spikes[:, ::4] = 0  # as many gaps, all of them upright lines
    assert compare(Texture(), clumps, spikes) < 0.75
    assert compare(Mix(), clumps, spikes) < compare(Mix(), clumps, seen(tree(holes=0.2)))
