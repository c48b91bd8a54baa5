"""The tasks that measure: benchmark, fidelity and speed_study, small."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import ClassVar, cast

import pytest

from experiments import benchmark, fidelity, rival_views, speed_study
from experiments.benchmark import compare_us, measure
from experiments.fidelity import parts
from experiments.numbers import rounded
from experiments.page_faults import faults_per_call
from experiments.sized_trees import trees_of
from experiments.speed_page import Point, page
from experiments.timing import in_turn
from experiments.view_fidelity import random_plants
from generators.simplegen import SimpleGen
from tests.experiments.program import finish
from treefit.plant import Budget
from treefit.similarity import PaperSimilarity
from treefit.view import Frame, OrthographicView


def run(here: Path, *settings: str) -> dict[str, object]:
    """Last line of the output of a task."""
    last: dict[str, object] = json.loads(finish(here, "hydra.run.dir=out", *settings).stdout.splitlines()[-1])
    return last


MISSING = "offscreen OpenGL does not work (no library)"


@pytest.fixture
def _no_gl(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (fidelity, rival_views):
        monkeypatch.setattr(module, "gl_missing", lambda: MISSING)


@pytest.mark.slow
@pytest.mark.usefixtures("_no_gl")
def test_fidelity_writes_what_it_found_and_passes_over_missing_libraries(tmp_path: Path) -> None:
    told = run(tmp_path, "task=fidelity", "fidelity.plants=20", "fidelity.rows=[64]")
    kept = json.loads((tmp_path / "out" / "fidelity.json").read_text(encoding="utf-8"))
    assert kept["plants"] == told["plants"] == 20
    assert {one["rows"] for one in kept["view"]} == {64}
    assert kept["view"][0]["similarity"] == "whole"
    assert kept["pyrender"] == told["pyrender"] == MISSING
    assert kept["view"][0]["spearman_least"] <= kept["view"][0]["spearman"] <= 1


@pytest.mark.slow
@pytest.mark.usefixtures("_no_gl")
def test_speed_study_writes_its_table_and_plot_to_the_run_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(speed_study, "PASSES", 1)
    told = run(tmp_path, "task=speed_study", "speed_study.vertices=[200,400]", "speed_study.rows=[64,128]")
    assert told["table"] == str(tmp_path / "out" / "speed.md")
    text = (tmp_path / "out" / "speed.md").read_text(encoding="utf-8")
    assert "python run.py task=speed_study" in text
    assert "| 5," in text or "| 4," in text  # the size that stays while the rows change
    assert (tmp_path / "out" / "speed.png").stat().st_size > 10_000


@pytest.mark.slow
def test_benchmark_tells_every_part_of_an_evaluation(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, less in {"TREES": 2, "BATCHES": 1, "LARGE_TREES": 1}.items():
        monkeypatch.setattr(benchmark, name, less)
    facts = measure(SimpleGen(), OrthographicView(), PaperSimilarity(), 0)
    assert {"evaluations_per_second", "generate_ms", "view_ms", "compare_us", "paper_compare_us", "ns_per_primitive",
            "page_faults", "two_threads_ratio", "azimuths_4_ratio", "zbuffer_ratio", "opencv_ratio",
            "pyrender_ratio"} <= set(facts)  # fmt: skip
    assert facts["vertices"] == pytest.approx(5000, rel=0.1)
    large = cast(dict[str, float], facts["large"])
    assert large["vertices"] > 50_000
    assert large["evaluate_ns_per_primitive"] > large["grow_ns_per_primitive"] > 0
    assert json.loads(json.dumps(rounded(facts))) == rounded(facts)


class Joined(PaperSimilarity):
    """A similarity that says what it is made of."""

    terms: ClassVar[dict[str, PaperSimilarity]] = {"coarse": PaperSimilarity(stripes=8), "fine": PaperSimilarity()}


def test_terms_of_a_similarity_are_measured_one_by_one() -> None:
    generator, view = SimpleGen(), OrthographicView()
    assert list(parts(Joined())) == ["whole", "coarse", "fine"]
    assert list(parts(PaperSimilarity())) == ["whole"]
    plant = next(random_plants(generator, 0))
    found = compare_us(Joined(), view, [plant], Frame(64, 2))
    assert list(cast(dict[str, float], found["terms_compare_us"])) == ["coarse", "fine"]
    assert "terms_compare_us" not in compare_us(PaperSimilarity(), view, [plant], Frame(64, 2))


def test_trees_are_of_the_wanted_size_also_where_random_ones_are_not() -> None:
    generator, wanted = SimpleGen(), [(300, 600), (60_000, 120_000)]
    for size, genomes in zip(wanted, trees_of(generator, wanted, 2, 0, draws=200), strict=True):
        for genome in genomes:
            plant = generator(generator.space.decode(genome), 0, Budget(200_000, 400_000))
            assert abs(math.log(plant.n_vertices / size[0])) + abs(math.log(plant.n_leaves / size[1])) < 0.8


def test_numbers_keep_three_digits_wherever_they_are() -> None:
    assert rounded({"a": 1234.5, "b": [0.0012345, 7], "c": "x", "d": None}) == {
        "a": 1230.0, "b": [0.00123, 7], "c": "x", "d": None,
    }  # fmt: skip


def test_memory_that_is_touched_anew_is_seen_in_page_faults() -> None:
    faults = faults_per_call(lambda size: bytearray(size), [64 << 20])
    if faults is None:
        pytest.skip("this system counts no page faults")
    assert faults > 10
    assert faults_per_call(lambda _: None, [0]) == 0


def test_times_are_taken_of_every_call_in_turn() -> None:
    order: list[str] = []
    calls = {name: (lambda _, name=name: order.append(name)) for name in "ab"}
    assert set(in_turn(calls, [0], rounds=2)) == {"a", "b"}
    assert order == ["a", "b"] * 3


def test_the_page_says_how_much_slower_others_are(tmp_path: Path) -> None:
    point = Point(1000, 2000, 128, {"growing the tree itself": 1.0, "bit rows (ours)": 0.5, "other": 6.0})
    text = page("simplegen", [point], [point], tmp_path / "speed.png", "mean of 3 trees")
    assert "| 1,000 | 2,000 | 128 | 1 | 0.5 | 6 (12x) |" in text
