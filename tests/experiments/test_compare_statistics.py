"""Statistics, page and plots of the task compare, on made-up runs."""

from __future__ import annotations

from dataclasses import replace
from math import inf, isnan
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from experiments.compare_page import page
from experiments.compare_plot import draw_curves
from experiments.compare_runs import Label, Run
from experiments.compare_settings import Compare
from experiments.compare_statistics import Group, differences, friedman, means, quartiles, ranks, signed_rank
from experiments.compare_study import Study, numbers

HARDNESS = {"oak": 0.0, "elm": 0.2, "ash": 0.4}
SKILL = {"mine": 0.1, "tree_ga": 0.05, "tree_ga_authors": 0.06}


def made(optimizer: str, target: str, repeat: int, generator: str = "simplegen") -> Run:
    """Run whose score is a sum of what its optimiser, target and repeat add; it has half of it at 40 evaluations."""
    score = 0.3 + HARDNESS[target] + SKILL[optimizer] + 0.01 * repeat
    label = Label(generator, target, optimizer, repeat)
    return Run(label, 100, (10, 40), (score / 2, score), score - 0.1, 2.0, 0.1, 0)


def runs(generator: str = "simplegen") -> list[Run]:
    return [made(one, target, repeat, generator) for repeat in range(2) for target in HARDNESS for one in SKILL]


def study(*found: Run, generators: tuple[str, ...] = ("simplegen",)) -> Study:
    wanted = Compare(optimizers=tuple(SKILL), generators=generators, evaluations=100, budgets=(20, 50, 1000))
    return Study(wanted, dict.fromkeys(SKILL, "Recipe()"), dict.fromkeys(generators, "simplegen 2"), 0, 5, 18, found)


def group(*found: Run) -> Group:
    return Group.of("simplegen", SKILL, found)


def test_means_are_over_targets_with_repeats_averaged_first() -> None:
    mean, error = means(group(*runs()).at(100))
    assert mean == pytest.approx([0.605, 0.555, 0.565])
    assert error == pytest.approx([0.2 / 3**0.5] * 3)
    assert isnan(means(np.array([[0.5], [0.6]]))[1][0])


def test_neither_hard_targets_nor_bad_optimizers_are_errors_of_a_difference() -> None:
    rng = np.random.default_rng(0)
    scores = rng.normal(size=(3, 4000)) * [[1], [1], [30]] + rng.normal(size=4000) * 50
    assert differences(scores)[1][:2] == pytest.approx([0, (2 / 4000) ** 0.5], rel=0.1)


def test_differences_are_to_the_first_and_paired() -> None:
    mean, error = differences(group(*runs()).at(100))
    assert mean == pytest.approx([0, -0.05, -0.04])
    assert error == pytest.approx([0, 0, 0], abs=1e-12)


def test_only_places_that_all_optimizers_have_are_compared() -> None:
    some = [run for run in runs() if (run.label.optimizer, run.label.target, run.label.repeat) != ("mine", "elm", 1)]
    found = group(*some)
    assert ("elm", 1) not in found.places
    assert len(found.places) == 5
    assert group(*(run for run in runs() if run.label.optimizer != "mine")).optimizers == ("tree_ga", "tree_ga_authors")


def test_the_stronger_reference_sets_the_score_to_be_reached() -> None:
    found = group(*runs())
    assert found.stronger(("tree_ga", "tree_ga_authors", "unknown"), 100) == "tree_ga_authors"
    assert found.stronger(("unknown",), 100) is None
    assert found.reach("mine", "tree_ga_authors", 100) == [40] * 6
    assert found.reach("tree_ga", "tree_ga_authors", 100) == [inf] * 6


def test_quartiles_of_counts_may_be_never() -> None:
    assert quartiles([1, 2, 3, 4, 5]) == (2, 3, 4)
    assert quartiles([1, 2, 3, inf]) == (1.75, 2.5, inf)
    assert quartiles([1, inf]) == (inf, inf, inf)
    assert quartiles([7]) == (7, 7, 7)
    assert quartiles([1, 2, inf, inf, inf])[0] == 2


def test_tests_of_rank_know_who_is_better() -> None:
    scores = np.array([np.linspace(0.5, 0.9, 12), np.linspace(0.4, 0.8, 12), np.linspace(0.5, 0.9, 12)])
    p = signed_rank(scores)
    assert isnan(p[0])
    assert p[1] < 0.001
    assert p[2] == 1.0
    assert ranks(scores) == pytest.approx([1.5, 3, 1.5])
    assert friedman(scores) < 0.001
    assert isnan(friedman(scores[:2]))


def test_the_page_tells_means_differences_and_reach() -> None:
    text = page(study(*runs()), ["task=compare", "compare.masks='/home/me/photos/mask_*.png'"], ["curves.png"])
    assert "'compare.masks=photos/mask_*.png'" in text
    assert "![Score by evaluations](curves.png)" in text
    assert "| optimizer | 20 | 50 | 100 |" in text
    assert "| mine | 0.3025 ± 0.0577 | 0.6050 ± 0.1155 | 0.6050 ± 0.1155 |" in text
    assert "score that tree_ga_authors has" in text
    assert "| mine | 40 [40, 40], 100% |" in text
    assert "| tree_ga | never [never, never], 0% |" in text
    assert "| 5.0% | 2.0 |" in text
    assert "| oak | **0.4050** |" in text
    assert "So far" not in text
    assert "So far 17 of 18 searches" in page(study(*runs()[1:]), [], [])


def test_an_optimizer_that_beats_the_first_by_two_errors_is_bold() -> None:
    better = [
        replace(run, scores=(0.1, run.scores[1] + 0.2)) if run.label.optimizer == "tree_ga" else run for run in runs()
    ]
    text = page(study(*better), [], [])
    assert "**+0.1500 ± 0.0000**" in text
    assert "**-" not in text


def test_generators_are_joined_when_there_are_several() -> None:
    both = study(*runs(), *runs("weberpenn"), generators=("simplegen", "weberpenn"))
    assert both.whole is not None
    assert len(both.whole.targets) == 6
    assert "## All generators" in page(both, [], [])
    assert study(*runs()).whole is None


def test_numbers_for_programs_are_whole(tmp_path: Path) -> None:
    found = numbers(group(*runs()), study().wanted)
    assert found["mine"]["score"][100] == pytest.approx([0.605, 0.2 / 3**0.5])  # type: ignore[index]
    assert found["tree_ga"]["reach_quartiles"] == [None, None, None]
    assert found["mine"]["own_time"] == pytest.approx(0.05)


@pytest.mark.parametrize("behind", [False, True])
def test_plots_have_a_panel_a_generator(tmp_path: Path, behind: bool) -> None:
    groups = [group(*runs()), group(*runs()), group(*runs())]
    draw_curves(groups, 100, tmp_path / "sub" / "curves.png", behind=behind)
    width, height = Image.open(tmp_path / "sub" / "curves.png").size
    assert width > 2.5 * height
