"""What a run shows in the terminal: progress while it searches, a table and the next commands at its end."""

from __future__ import annotations

import logging
import shlex
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from threading import Timer
from types import TracebackType
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, track
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
            TextColumn("searching"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("best [bold]{task.fields[best]:.4f}[/]  {task.fields[rate]:,.0f}/s  {task.fields[left]}"),
            console=self.console,
            transient=True,
            disable=not self.console.is_terminal,
        )
        self._task = self._bar.add_task("search", total=None, best=0.0, rate=0.0, left="")
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

    def update(self, evaluations: int, total: int, best: float, rate: float) -> None:
        """Show `evaluations` of `total` done, the `best` score so far and the `rate` per second."""
        self._patience.cancel()
        left = time_left(total - evaluations, rate)
        self._bar.update(self._task, completed=evaluations, total=total, best=best, rate=rate, left=left)
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
    if rate <= 0:
        return "time left unknown"
    minutes, seconds = divmod(round(evaluations / rate), 60)
    return f"{minutes} min {seconds} s left" if minutes else f"{seconds} s left"


def print_results(console_rows: Sequence[Mapping[str, str]], folder: Path, where: str) -> None:
    """Print the candidates (one row each, columns by key, best first) and the two commands to go on with.

    `folder` is the run's, with its viewer.html; `where` says how to browse the run, "" when it is not kept.
    """
    console = Console()
    if console_rows:
        console.print(_table(console_rows))
    _next_commands(console, f"results  {folder}", folder / "viewer.html", where)


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
