"""What a run shows in the terminal: progress while it searches, a table and the next commands at its end."""

from __future__ import annotations

import logging
import shlex
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import Timer
from types import TracebackType
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, TextColumn, track
from rich.progress import Progress as Bar
from rich.table import Table

Item = TypeVar("Item")

SECONDS_BETWEEN_LINES = 10.0
"""How often a line is printed where no bar can be drawn."""

SECONDS_OF_SILENCE = 2.0
"""How long nothing may be seen to happen at the start before a line says why."""


class Progress:
    """Progress of a search: a live bar on a terminal, now and then a line elsewhere. Use in `with`."""

    def __init__(self, console: Console | None = None, silence: float = SECONDS_OF_SILENCE) -> None:
        self.console = console or Console(stderr=True)
        self._bar = Bar(
            TextColumn("{task.description}", markup=False),
            BarColumn(bar_width=None),
            TextColumn("{task.fields[done]}  best [bold]{task.fields[best]:.4f}[/]  {task.fields[speed]}"),
            console=self.console,
            transient=True,
            expand=True,
            disable=not self.console.is_terminal,
        )
        self._task = self._bar.add_task("beginning", total=None, best=0.0, done="", speed="")
        self._next_line = 0.0
        self._patience = Timer(silence, self._explain_silence)
        self._patience.daemon = True

    def __enter__(self) -> Progress:
        self._bar.start()
        self._patience.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._patience.cancel()
        self._bar.stop()

    def update(self, evaluations: int, total: int, best: float, rate: float, stage: str = "searching") -> None:
        """Show `evaluations` of `total` done, the `best` score so far, the `rate` per second and the `stage`."""
        self._patience.cancel()
        left = time_left(total - evaluations, rate)
        taken = time_taken(evaluations / rate) if rate > 0 else "0 s"
        self._bar.update(self._task, completed=evaluations, total=total, description=stage, best=best,
                         done=f"{evaluations:,}/{total:,}", speed=f"{rate:,.0f}/s  {taken}, {left}")  # fmt: skip
        now = time.monotonic()
        if not self.console.is_terminal and (now >= self._next_line or evaluations >= total):
            self._next_line = now + SECONDS_BETWEEN_LINES
            self.console.print(
                f"{evaluations:,} of {total:,} evaluations, best {best:.4f}, {rate:,.0f} per second, {left}",
                highlight=False,
                soft_wrap=True,
            )

    def _explain_silence(self) -> None:
        line = "growing the first trees; the first run on a machine also compiles its kernels, some 25 s"
        self.console.print(line, highlight=False, soft_wrap=True)


@contextmanager
def patience(line: str, console: Console | None = None, silence: float = SECONDS_OF_SILENCE) -> Iterator[None]:
    """Say `line` once when what is done within takes longer than `silence` seconds."""
    console = console or Console(stderr=True)
    timer = Timer(silence, lambda: console.print(line, highlight=False, soft_wrap=True))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def counted(items: Sequence[Item], what: str, console: Console | None = None) -> Iterator[Item]:
    """Yield `items`, with a live bar on a terminal, and now and then a line "12 of 40 parameters" elsewhere."""
    console = console or Console(stderr=True)
    if console.is_terminal:
        yield from track(items, what, console=console, transient=True)
        return
    next_line = time.monotonic() + SECONDS_BETWEEN_LINES
    for i, item in enumerate(items):
        if time.monotonic() >= next_line:
            next_line = time.monotonic() + SECONDS_BETWEEN_LINES
            console.print(f"{i} of {len(items)} {what}", highlight=False)
        yield item


def time_left(evaluations: int, rate: float) -> str:
    """Words for the time that `evaluations` take at `rate` per second: "1 min 5 s left"."""
    if evaluations <= 0:
        return "done"
    return f"{time_taken(evaluations / rate)} left" if rate > 0 else "time left unknown"


def time_taken(seconds: float) -> str:
    """Words for a time: "5 s", "1 min 5 s", "2 h 3 min"."""
    minutes, seconds = divmod(round(seconds), 60)
    if minutes >= 60:
        return f"{minutes // 60} h {minutes % 60} min"
    return f"{minutes} min {seconds} s" if minutes else f"{seconds} s"


def print_results(console_rows: Sequence[Mapping[str, str]], folder: Path, where: str) -> None:
    """Print the candidates (one row each, columns by key, best first) and the two commands to go on with.

    `folder` is the run's, with its viewer.html; `where` says how to browse the run, "" when it is not kept.
    """
    console = Console()
    if console_rows:
        console.print(_table(console_rows))
    _next_commands(console, f"results  {folder}", folder / "viewer.html", where)


def print_live(page: Path) -> None:
    """Print how to watch the search."""
    line = f"live     python -m webbrowser {shlex.quote(page.resolve().as_uri())}"
    Console(stderr=True).print(line, highlight=False, markup=False, soft_wrap=True)


def print_sweep(count: int, failed: int, folder: Path, where: str) -> None:
    """Print how many runs of a sweep ended well, and where its table is."""
    _next_commands(
        Console(),
        f"sweep    {count - failed} of {count} runs done, {failed} failed",
        folder / "sweep.html",
        where,
    )


class OneLine(logging.Formatter):
    """Log records on one line each: what happened; where in the code is for run.log."""

    def format(self, record: logging.LogRecord) -> str:
        """Return "warning: text"."""
        return f"{record.levelname.lower()}: {' '.join(record.getMessage().split())}"


def _next_commands(console: Console, head: str, page: Path, where: str) -> None:
    lines = [head, f"look     python -m webbrowser {shlex.quote(page.resolve().as_uri())}"]
    for line in [*lines, f"browse   {where}"] if where else lines:
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def _table(rows: Sequence[Mapping[str, str]]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    for name in rows[0]:
        table.add_column("\n".join(name.split()), justify="right", vertical="bottom", no_wrap=True)
    for row in rows:
        table.add_row(*row.values())
    return table
