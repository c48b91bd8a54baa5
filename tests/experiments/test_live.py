"""The live page: what is on the disk while a search runs, when it ends, and when something fails."""

from __future__ import annotations

import logging
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from experiments import live
from experiments.live import Live
from experiments.read_tree import ReadTree
from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.experiments.test_search_stages import generation
from tests.foreign import Foreign, dead
from treefit.asset import AssetSettings
from treefit.fit import aim
from treefit.image import Extraction, Picture
from treefit.improvements import Improvement
from treefit.objective import Objective
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView


@pytest.fixture(scope="module")
def objective() -> Objective:
    return aim(blob(), SimpleGen(), PaperSimilarity(), Characteristics(), OrthographicView(resolution=64), 0)


@pytest.fixture(autouse=True)
def _quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, "BETWEEN", 0.01)
    monkeypatch.setattr(live, "HEIGHT", 64)


def page(folder: Path) -> Live:
    picture = Picture(np.full((128, 128, 3), 200, np.uint8))
    tree = ReadTree("pine.png", picture, Extraction(blob(), "file", 1.0, ""))
    return Live(folder, tree, "pine.png by simplegen", 1000, AssetSettings())


def middle(objective: Objective, evaluations: int = 100) -> Improvement:
    return Improvement(evaluations, 0.5, 0.5, (0.5,) * len(objective.space))


def wait_for(folder: Path, words: str) -> str:
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        text = (folder / "live.js").read_text(encoding="utf-8") if (folder / "live.js").exists() else ""
        if words in text:
            return text
        time.sleep(0.01)
    raise AssertionError(f"{words!r} never came")


def test_a_page_follows_the_search_and_ends_with_links(tmp_path: Path, objective: Objective) -> None:
    (tmp_path / "viewer.html").touch()
    with page(tmp_path) as shown:
        assert "growing the first trees" in (tmp_path / "live.html").read_text(encoding="utf-8")
        shown.on_improvement(middle(objective), objective)
        shown.on_generation(generation(0, "random"))
        assert '"running": true' in wait_for(tmp_path, "the best after 100")
        shown.searched()
        wait_for(tmp_path, live.WRITING)
    for name in ("live.html", "live.js"):
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert '"running": false' in text
        assert '"state": "done"' in text
        assert '"viewer.html"' in text
        assert "gallery.png" not in text
    assert not list(tmp_path.glob("*.tmp"))


@pytest.mark.parametrize(
    ("error", "words"), [(KeyboardInterrupt(), "stopped"), (ValueError("no\nway"), "failed: no way")]
)
def test_a_page_says_how_the_run_ended(tmp_path: Path, error: BaseException, words: str) -> None:
    with pytest.raises(type(error)), page(tmp_path):
        raise error
    assert f'"state": "{words}"' in (tmp_path / "live.html").read_text(encoding="utf-8")


def test_a_plant_that_cannot_be_drawn_is_said_once_and_the_numbers_go_on(
    tmp_path: Path, objective: Objective, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live, "drawn_panels", lambda *_: 1 / 0)
    with caplog.at_level(logging.WARNING), page(tmp_path) as shown:
        for i in range(3):
            shown.on_improvement(middle(objective, i + 1), objective)
            shown.on_generation(generation(i, "random"))
            wait_for(tmp_path, f'"evaluations": "{100 * (i + 1)}"')
    assert [record.getMessage() for record in caplog.records] == ["live page: division by zero"]


def test_a_folder_that_is_gone_does_not_end_the_run(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    with page(tmp_path / "gone") as shown:
        shown.on_generation(generation(0, "random"))
        time.sleep(0.05)
    assert len(caplog.records) == 1


def test_the_curve_of_a_run_that_goes_on_begins_where_the_run_began(tmp_path: Path) -> None:
    shown = page(tmp_path)
    for number in (0, 1, 2, 3, 2, 3, 4):
        shown.on_generation(generation(number, "random"))
    assert [line.number for line in shown._now().history] == [0, 1, 2, 3, 4]


def test_a_long_history_is_thinned_but_for_its_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, "MOST_KEPT", 50)
    shown = page(tmp_path)
    for number in range(1000):
        shown.on_generation(generation(number, "random"))
        assert shown._now().history[-1].number == number
    assert len(shown._now().history) <= 51
    assert shown._now().history[0].number == 0


def test_a_plant_that_cannot_be_grown_again_is_skipped_and_a_later_one_is_shown(
    tmp_path: Path, objective: Objective, caplog: pytest.LogCaptureFixture
) -> None:
    flaky = replace(objective, generator=Foreign(lambda number, _, seed: dead() if number == 0 else seed))
    with caplog.at_level(logging.WARNING), page(tmp_path) as shown:
        shown.on_improvement(middle(flaky, 1), flaky)
        shown.on_generation(generation(0, "random"))
        wait_for(tmp_path, '"evaluations": "100"')
        shown.on_improvement(middle(flaky, 2), flaky)
        shown.on_generation(generation(1, "random"))
        assert "the best after 1 " not in wait_for(tmp_path, "the best after 2")
    assert caplog.messages == []
