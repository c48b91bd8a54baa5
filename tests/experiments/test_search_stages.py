import json
from dataclasses import asdict
from pathlib import Path

import pytest

from experiments.search_stages import Stage, labels_of, read_history, stage_name, stages_of
from treefit.progress import Generation


def generation(number: int, stage: str, best: float = 0.5) -> Generation:
    return Generation(number, stage, 100 * (number + 1), best, best, best / 2, 0, 0, 1.0, 100.0)


TREE = ("level 1/2, 2 x generation 0", "level 1/2, 2 x generation 1", "level 2/2, 1 x generation 1", "candidate 2",
        "candidate 3")  # fmt: skip
STARTS = ("first genomes", "start 1, generation 0, spread 0.100", "start 1, generation 1, spread 0.091",
          "start 2, generation 0, spread 0.150")  # fmt: skip


@pytest.mark.parametrize(
    ("stage", "name"),
    [(TREE[0], "level 1/2"), (STARTS[1], "start 1"), ("first genomes", "first genomes"), ("random", "random"),
     ("a, b", "a, b"), ("", "")],
)  # fmt: skip
def test_the_name_of_a_stage_has_no_generation(stage: str, name: str) -> None:
    assert stage_name(stage) == name


def test_stages_are_the_levels_of_a_tree_of_gas() -> None:
    stages = stages_of([generation(i, stage) for i, stage in enumerate(TREE)])
    assert stages == [Stage("level 1/2", 2, 0, 200), Stage("level 2/2", 1, 200, 300),
                      Stage("candidate 2", 1, 300, 400), Stage("candidate 3", 1, 400, 500)]  # fmt: skip
    assert [label.words[0] for label in labels_of(stages)] == ["level 1/2: 2 GAs", "level 2/2: the root",
                                                              "candidates 2, 3"]  # fmt: skip


def test_stages_are_the_restarts_of_a_search() -> None:
    stages = stages_of([generation(i, stage) for i, stage in enumerate(STARTS)])
    assert [(stage.name, stage.first, stage.last) for stage in stages] == [
        ("first genomes", 0, 100), ("start 1", 100, 300), ("start 2", 300, 400),
    ]  # fmt: skip
    assert [label.words for label in labels_of(stages)] == [
        ("first genomes",), ("start 1", "1"), ("start 2", "2"),
    ]  # fmt: skip


def test_words_of_a_label_become_shorter() -> None:
    many = [generation(i, f"candidate {i + 2}") for i in range(4)]
    for label in labels_of(stages_of([generation(0, TREE[0]), *many])):
        lengths = [len(words) for words in label.words]
        assert lengths == sorted(lengths, reverse=True)
    assert labels_of(stages_of(many))[0].words[0] == "candidates 2–5"


def test_history_is_read_back_but_for_a_line_that_is_half(tmp_path: Path) -> None:
    lines = [generation(i, stage) for i, stage in enumerate(TREE)]
    text = "".join(json.dumps(asdict(line)) + "\n" for line in lines)
    (tmp_path / "history.jsonl").write_text(text + '{"number": 5, "sta', encoding="utf-8")
    assert read_history(tmp_path / "history.jsonl") == lines
    assert read_history(tmp_path / "nothing.jsonl") == []
