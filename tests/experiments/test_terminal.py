import io
import logging
import time
from pathlib import Path

import pytest
from rich.console import Console

from experiments.terminal import OneLine, Progress, counted, patience, print_live, print_results, print_sweep, time_left


def test_progress_draws_a_bar_on_a_terminal() -> None:
    out = io.StringIO()
    with Progress(Console(file=out, force_terminal=True, width=120)) as progress:
        progress.update(500, 1000, 0.75, 250.0, "level 1/2")
        progress._bar.refresh()
    for words in ("level 1/2", "500/1,000", "best", "0.7500", "250/s", "2 s, 2 s left"):
        assert words in out.getvalue()


@pytest.mark.parametrize("width", [72, 80, 200])
def test_the_bar_has_room_on_one_line(width: int) -> None:
    console = Console(file=io.StringIO(), force_terminal=True, width=width, color_system=None)
    with Progress(console) as progress:
        progress.update(12_345, 500_000, 0.8123, 1931.4, "level 2/4")
        shown = progress._bar.get_renderable()
    lines = ["".join(part.text for part in line).rstrip() for line in console.render_lines(shown)]
    assert lines[0].startswith("level 2/4 ")
    assert lines[0].endswith("12,345/500,000  best 0.8123  1,931/s  6 s, 4 min 12 s left")
    assert not "".join(lines[1:])


def test_progress_is_a_line_now_and_then_elsewhere() -> None:
    out = io.StringIO()
    with Progress(Console(file=out)) as progress:
        for done in range(0, 1001, 10):
            progress.update(done, 1000, 0.5, 250.0)
    assert out.getvalue().splitlines() == [
        "0 of 1,000 evaluations, best 0.5000, 250 per second, 4 s left",
        "1,000 of 1,000 evaluations, best 0.5000, 250 per second, done",
    ]


def test_silence_at_the_start_is_explained_once() -> None:
    out = io.StringIO()
    with Progress(Console(file=out), silence=0.01) as progress:
        progress._patience.join()
        progress.update(1000, 1000, 0.5, 250.0)
    first, last = out.getvalue().splitlines()
    assert first.startswith("growing the first trees; the first run")
    assert last.startswith("1,000 of 1,000")


@pytest.mark.parametrize(
    ("evaluations", "rate", "words"),
    [
        (0, 5.0, "done"),
        (100, 0.0, "time left unknown"),
        (650, 10.0, "1 min 5 s left"),
        (50, 10.0, "5 s left"),
        (36_059, 10.0, "1 h 0 min left"),
        (36_000, 1.0, "10 h 0 min left"),
    ],
)
def test_time_left_in_words(evaluations: int, rate: float, words: str) -> None:
    assert time_left(evaluations, rate) == words


def test_a_live_page_is_told_with_the_command_that_opens_it(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    print_live(tmp_path / "my run" / "live.html")
    assert capsys.readouterr().err == f"live     python -m webbrowser {(tmp_path / 'my run' / 'live.html').as_uri()}\n"


def test_results_end_with_the_next_commands(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    folder = tmp_path / "my run"
    print_results([{"candidate": "1", "score": "0.812", "vertices": "12,345"}], folder, "mlflow ui")
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["candidate", "score", "vertices"]
    assert lines[1].split() == ["1", "0.812", "12,345"]
    assert lines[3] == f"look     python -m webbrowser {(folder / 'viewer.html').as_uri()}"
    assert lines[4] == "browse   mlflow ui"


def test_sweep_says_how_many_failed(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    print_sweep(6, 1, tmp_path, "")
    assert capsys.readouterr().out.startswith("sweep    5 of 6 runs done, 1 failed\n")


def test_log_on_the_terminal_is_one_line_without_the_place_in_the_code() -> None:
    try:
        raise RuntimeError
    except RuntimeError as error:
        trace = (type(error), error, error.__traceback__)
    record = logging.LogRecord("x", logging.ERROR, "f", 1, "two\nlines", None, trace)
    assert OneLine().format(record) == "error: two lines"


def test_what_is_counted_comes_through_and_lines_tell_of_it_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    quick, slow = io.StringIO(), io.StringIO()
    assert list(counted(["a", "b", "c"], "letters", Console(file=quick))) == ["a", "b", "c"]
    monkeypatch.setattr("experiments.terminal.SECONDS_BETWEEN_LINES", 0.0)
    assert list(counted(["a", "b", "c"], "letters", Console(file=slow))) == ["a", "b", "c"]
    assert (quick.getvalue(), slow.getvalue().splitlines()[1:]) == ("", ["1 of 3 letters", "2 of 3 letters"])


def test_what_takes_longer_is_told_once_and_what_is_quick_is_not() -> None:
    out = io.StringIO()
    with patience("writing", Console(file=out), silence=0.01):
        deadline = time.monotonic() + 10
        while not out.getvalue() and time.monotonic() < deadline:
            time.sleep(0.005)
    assert out.getvalue() == "writing\n"
    with patience("writing", Console(file=out), silence=60):
        pass
    assert out.getvalue() == "writing\n"
