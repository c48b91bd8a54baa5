import json
from pathlib import Path

from experiments.run_log import RunLog
from tests.experiments.test_search_stages import generation
from treefit.progress import Failure


def lost(reason: str) -> Failure:
    return Failure(reason, {"wobble": 0.5}, 3)


def told(folder: Path) -> list[tuple[int, str]]:
    lines = (folder / "failures.jsonl").read_text(encoding="utf-8").splitlines()
    found = [json.loads(line) for line in lines]
    assert all(line["values"] == {"wobble": 0.5} and line["seed"] == 3 for line in found)
    return [(line["generation"], line["reason"]) for line in found]


def test_what_is_left_out_after_the_search_is_logged_beside_what_failed_in_it(tmp_path: Path) -> None:
    log = RunLog(tmp_path)
    log.write(generation(0, "a"), [lost("TimedOut: 1")])
    log.left_out(1, lost("TimedOut: 2"))
    log.write(generation(1, "b"), [lost("TimedOut: 3")])
    assert told(tmp_path) == [(0, "TimedOut: 1"), (1, "TimedOut: 2"), (1, "TimedOut: 3")]
    assert len((tmp_path / "history.jsonl").read_text(encoding="utf-8").splitlines()) == 2


def test_a_run_that_goes_on_after_its_search_logs_what_is_left_out_once(tmp_path: Path) -> None:
    for _ in range(2):
        log = RunLog(tmp_path)
        if not log.failed.exists():
            log.write(generation(0, "a"), [lost("TimedOut: 1")])
        log.left_out(1, lost("TimedOut: 2"))
    assert told(tmp_path) == [(0, "TimedOut: 1"), (1, "TimedOut: 2")]
