from __future__ import annotations

import re
from dataclasses import fields, replace

import pytest

from experiments.candidate_facts import BY_NAME, FACTS, metrics, record
from experiments.candidate_words import caption, row, tables
from experiments.terminal import print_results
from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.asset import MeshCounts
from treefit.candidates import Candidate, judge
from treefit.fit import aim
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.similarity.measures import Agreement
from treefit.view import OrthographicView

MESH = MeshCounts(90_000, 123_456)
TARGET = blob(256, 256)


@pytest.fixture(scope="module")
def found() -> Candidate:
    objective = aim(TARGET, SimpleGen(), PaperSimilarity(), Characteristics(vertices=2000), OrthographicView(64), 3)
    middle = objective.space.encode(objective.space.complete({}))
    return judge(objective, middle, TARGET, 2)


@pytest.fixture
def alone(found: Candidate) -> Candidate:
    return replace(found, score_other_seeds=None, agreement_other_seeds=None)


def test_every_measure_is_told_on_the_seed_and_on_others(found: Candidate) -> None:
    known = record(found, MESH)
    assert found.agreement_other_seeds is not None
    for field in fields(Agreement):
        assert known[field.name] == getattr(found.agreement, field.name)
        assert known[f"{field.name}_other_seeds"] == getattr(found.agreement_other_seeds, field.name)
    assert known["score_other_seeds"] == found.score_other_seeds
    assert known["triangles"] == 123_456


def test_metrics_have_names_that_a_tracker_takes_and_only_numbers(found: Candidate, alone: Candidate) -> None:
    known = metrics(found, MESH)
    assert known["hull_iou_other_seeds"] == round(record(found, MESH)["hull_iou_other_seeds"], 4)
    assert all(re.fullmatch(r"[\w/]+", name) for name in known)
    assert {name.removeprefix("more/") for name in metrics(alone, MESH)} == set(BY_NAME)


def test_the_row_fits_a_terminal_of_80_columns(found: Candidate, capsys: pytest.CaptureFixture[str], tmp_path) -> None:
    print_results([row(1, found, MESH)], tmp_path, "")
    lines = capsys.readouterr().out.splitlines()
    table = lines[: next(i for i, line in enumerate(lines) if line.startswith("results"))]
    assert max(map(len, table)) <= 80
    assert table[-1].split()[-3:] == ["123,456", f"{found.extent.height:.1f}", "m"]


def test_the_caption_is_short_and_leaves_out_what_is_not_known(found: Candidate, alone: Candidate) -> None:
    lines = caption(found, MESH)
    assert len(lines) == 4
    assert lines[0] == f"score {found.score.total:.3f}, other seeds {found.score_other_seeds:.3f}"
    assert lines[-1] == f"{found.plant.n_vertices:,} vertices, {found.plant.n_leaves:,} leaves"
    assert caption(alone, MESH)[0] == f"score {found.score.total:.3f}"


def test_the_tables_tell_every_fact_once(found: Candidate, alone: Candidate) -> None:
    for candidate, columns in ((found, 2), (alone, 1)):
        names = [line.name for table in tables(candidate, MESH) for line in table.rows]
        assert names == [fact.words for fact in FACTS]
        assert all(len(line.values) == columns for table in tables(candidate, MESH)[:2] for line in table.rows)


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [("score", 0.8123, "score 0.812"), ("vertices", 12345, "12,345 vertices"), ("height_m", 9.96, "height 10.0 m"),
     ("bare_trunk_error", 2.04, "bare trunk +2.0 %"), ("hull_iou", None, "hull IoU -")],
)  # fmt: skip
def test_facts_in_words(name: str, value: float | None, words: str) -> None:
    assert BY_NAME[name].phrase(value) == words
