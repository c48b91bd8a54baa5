"""Which statistics a search finds: those of its generator, version, similarity and space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generators.gegen import gegen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.family.counted import Counted, statistics
from treefit.family.identity import StaleError, fingerprint
from treefit.family.statistics import Statistics, find_statistics
from treefit.plant import Generator, ParameterSpace
from treefit.similarity import Mix, PaperSimilarity

SHIPPED = [SimpleGen, WeberPennGen, gegen]


@pytest.mark.parametrize("make", SHIPPED, ids=lambda make: make.__name__)
def test_every_generator_has_small_statistics_that_fit_the_default_search(make: Callable[[], Generator]) -> None:
    generator = make()
    found = find_statistics(generator, Mix())
    assert found is not None
    assert set(found.names) == set(generator.space.names)
    assert found.evaluations > 500_000
    assert np.ptp(found.rate) > 0
    assert generator.family is not None
    assert all(path.stat().st_size < 100_000 for path in generator.family.glob("statistics*.npz"))


def test_without_files_there_are_no_statistics(tmp_path: Path) -> None:
    assert find_statistics(Counted(family=None), Mix()) is None
    assert find_statistics(Counted(family=tmp_path / "none"), Mix()) is None


def test_of_several_files_the_one_of_the_similarity_and_the_most_like_space_is_found(tmp_path: Path) -> None:
    paper = statistics(similarity=fingerprint(PaperSimilarity()))
    fewer = SimpleGen(fixed={**SimpleGen().fixed, "wobble": 0.1})
    for name, one in {"": statistics(), "_paper": paper, "_fewer": statistics(fewer)}.items():
        one.write(tmp_path / f"statistics{name}.npz")
    (tmp_path / "guess.npz").write_bytes(b"of somebody else")
    assert _same(find_statistics(Counted(family=tmp_path), Mix()), statistics())
    assert _same(find_statistics(Counted(family=tmp_path), PaperSimilarity()), paper)
    assert _same(find_statistics(Counted(fewer.fixed, family=tmp_path), Mix()), statistics(fewer))


def test_statistics_of_other_weights_are_no_statistics_but_nothing_is_wrong(tmp_path: Path) -> None:
    statistics(version="0").write(tmp_path / "statistics.npz")
    assert find_statistics(Counted(family=tmp_path), Mix(weights={**Mix().weights, "trunk": 1.0})) is None


def test_statistics_of_another_version_are_refused_with_the_command_that_renews_them(tmp_path: Path) -> None:
    statistics(version="0").write(tmp_path / "statistics.npz")
    command = r"python run.py task=statistics generator=simplegen statistics.renew=true"
    with pytest.raises(StaleError, match=rf"statistics.npz is of version 0, the generator of 2; renew them: {command}"):
        find_statistics(Counted(family=tmp_path), Mix())
    statistics().write(tmp_path / "statistics_new.npz")
    assert find_statistics(Counted(family=tmp_path), Mix()) is not None


def test_statistics_of_another_range_are_refused_but_those_of_another_space_left_out(tmp_path: Path) -> None:
    statistics().write(tmp_path / "statistics.npz")
    known = SimpleGen().space
    wider = tuple(replace(one, high=2 * one.high) if one.name == "lean" else one for one in known.parameters)

    class Wide(Counted):
        """SimpleGen that leans more."""

        space = ParameterSpace(wider, known.fixed)  # type: ignore[assignment]

    class Full(Wide):
        """SimpleGen that leans more and has genes that nothing is known of."""

        space = ParameterSpace(wider)  # type: ignore[assignment]

    with pytest.raises(StaleError, match=r"parameter 'lean' has another range than in statistics\.npz"):
        find_statistics(Wide(family=tmp_path), Mix())
    assert find_statistics(Full(family=tmp_path), Mix()) is None


def _same(found: Statistics | None, other: Statistics) -> bool:
    return found is not None and (found.genes, found.similarity) == (other.genes, other.similarity)
