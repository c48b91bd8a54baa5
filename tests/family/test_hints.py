"""What is known before a search: the plants that it begins from, and the generator's own."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.conftest import blob
from tests.failing import Failing
from tests.family.counted import Counted, statistics
from treefit.family.features import features
from treefit.family.guess import Guess, find_guess
from treefit.family.hints import DRAWS, hints_of
from treefit.fit import aim
from treefit.objective import Objective
from treefit.plant import Generator, ParameterSpace
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Mix, PaperSimilarity
from treefit.view import BitMask, OrthographicView, sample

GENERATOR, SPACE = WeberPennGen(), SimpleGen().space
OBJECTIVE = aim(blob(), GENERATOR, PaperSimilarity(), Characteristics(), OrthographicView(), 0)


def test_the_plants_to_begin_from_come_before_those_of_the_generator() -> None:
    own = [preset.values for preset in GENERATOR.presets.values()]
    known = hints_of(OBJECTIVE, blob(), [own[3], {}]).known
    wanted = [own[3], {}, *own]
    np.testing.assert_array_equal(known, [OBJECTIVE.space.encode(values) for values in wanted])


def test_a_start_with_a_parameter_that_the_generator_lacks_is_named() -> None:
    with pytest.raises(
        ValueError, match="start 2 of generator 'weberpenn': no parameter 'levls'; did you mean 'levels'"
    ):
        hints_of(OBJECTIVE, blob(), [{}, {"levls": 2}])


def aimed(generator: Generator, **wishes: Any) -> Objective:
    return aim(blob(), generator, Mix(), Characteristics(**wishes), OrthographicView(), 0)


def test_rates_and_marks_of_the_statistics_reach_the_search(tmp_path: Path) -> None:
    tried, rng = np.full((len(SPACE), 5), 100), np.random.default_rng(0)
    above = rng.permuted(np.tile([2, 4, 6, 8, 30], (len(SPACE), 1)), axis=1)
    found = statistics(tried=tried, above=above)
    found.write(tmp_path / "statistics.npz")
    hints = hints_of(aimed(Counted(family=tmp_path)), blob())
    np.testing.assert_array_equal(hints.rate, np.arange(len(SPACE)))
    np.testing.assert_array_equal(hints.quality, found.quality())
    assert np.ptp(hints.quality) > 2


def test_guesses_are_draws_around_the_mean_in_the_unit_cube_with_their_spread() -> None:
    objective = aimed(SimpleGen())
    hints = hints_of(objective, blob())
    guess = find_guess(SimpleGen())
    assert guess is not None
    look = features(BitMask.pack(sample(blob(), objective.frame)))
    mean, deviation, _ = guess.for_space(SPACE, look, 3000)
    np.testing.assert_array_equal(hints.guess[0], mean)
    assert hints.guess.shape == (DRAWS, len(SPACE))
    assert 0 <= hints.guess.min() < hints.guess.max() <= 1
    inner = (np.abs(mean - 0.5) + 2 * deviation < 0.5).nonzero()[0]
    near, far = (hints.guess[first::2][:, inner].std(axis=0) for first in (2, 1))
    np.testing.assert_allclose(near / far, 0.5, atol=0.15)


def test_the_same_seed_guesses_the_same_and_another_does_not() -> None:
    objective = aimed(SimpleGen())
    one, again, other = (hints_of(replace(objective, seed=seed), blob()).guess.tobytes() for seed in (0, 0, 1))
    assert one == again != other


@pytest.mark.parametrize(("wish", "number"), [
    ([1000, 4000], 2000), ({"max": 800}, 800), ({"min": 5000}, 5000), ({"min": 1000, "max": 4000}, 2000),
])  # fmt: skip
def test_a_range_of_vertices_is_guessed_for_as_its_middle_and_a_limit_as_itself(wish: Any, number: int) -> None:
    ranged, plain, other = (hints_of(aimed(SimpleGen(), vertices=one), blob()).guess for one in (wish, number, 3000))
    np.testing.assert_array_equal(ranged, plain)
    assert np.abs(plain - other).max() > 0.01


@pytest.mark.parametrize(("wish", "told"), [(None, None), (3000, 3000.0)])
def test_without_a_wish_for_vertices_any_count_is_guessed_for(
    monkeypatch: pytest.MonkeyPatch, wish: int | None, told: float | None
) -> None:
    heard: list[float | None] = []
    monkeypatch.setattr(
        Guess, "for_space", lambda guess, space, look, vertices: heard.append(vertices) or _blank(space)
    )
    hints_of(aimed(SimpleGen(), vertices=wish), blob())
    assert heard == [told]


def _blank(space: ParameterSpace) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    n = len(space)
    return np.full(n, 0.5), np.full(n, 0.1), np.eye(n)


@pytest.mark.parametrize(
    "generator", [Counted(family=None), WeberPennGen(full=True), Failing()], ids=lambda one: one.name
)
def test_a_generator_of_which_nothing_was_counted_works_and_that_is_said_once(
    generator: Generator, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO, "treefit")
    hints = hints_of(aimed(generator), blob())
    assert (len(set(hints.rate)), np.ptp(hints.quality), len(hints.guess)) == (1, 0, 0)
    told = [(line.levelname, line.getMessage().partition(" of ")[0]) for line in caplog.records]
    assert told == [("INFO", "no statistics"), ("INFO", "no guess for these parameters")]


def test_a_part_of_the_parameters_with_others_that_were_fixed_takes_what_is_known_of_it() -> None:
    """As with generator=simplegen_paper, whose leaf_width is fixed in the default space."""
    generator = SimpleGen(fixed={name: SimpleGen().fixed[name] for name in ("branch_len_0", "branch_r_2")})
    hints = hints_of(aimed(generator), blob())
    at = generator.space.names.index("leaf_width")
    assert np.ptp(hints.quality[at]) == 0
    assert np.ptp(hints.rate) > 0
    assert len(hints.guess) == DRAWS


def test_statistics_of_other_weights_leave_the_guess() -> None:
    other = replace(Mix(), weights={**Mix().weights, "trunk": 1.0})
    hints = hints_of(replace(aimed(SimpleGen()), similarity=other), blob())
    assert np.ptp(hints.rate) == 0
    assert len(hints.guess) == DRAWS
