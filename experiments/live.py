"""Live page of a run: best plant and curve while the search goes on, drawn beside it on a thread of its own."""

from __future__ import annotations

import logging
import math
import shlex
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import TracebackType

import numpy as np

from experiments.errors import one_line
from experiments.live_page import DATA, PAGE, Addresses, Moment, data_text, embedded, page_text
from experiments.read_tree import ReadTree
from experiments.search_stages import read_history
from experiments.search_story import CURVE, STRIP
from experiments.standing import drawn_panels, given_panels, ratio_for
from treefit.asset import AssetSettings
from treefit.asset.formats.whole_file import write_whole
from treefit.improvements import Improvement
from treefit.objective import Objective
from treefit.placing import place
from treefit.progress import Generation

BETWEEN = 2.0
"""Seconds between two states of the page at least."""

SILENCE, PATIENCE = 10.0, 40.0
"""Seconds after which it is written though nothing is new, and after which a reader is told that it was not."""

SHARE = 0.06
"""Share of the time that drawing may take of one thread: the search waits for it now and then."""

HEIGHT = 400
"""Pixels of a picture."""

MOST_KEPT = 4000
"""Generations that the curve is drawn from."""

BEGINNING, SEARCHING, WRITING = "growing the first trees", "searching", "searched; writing the trees"

LINKS = (
    ("turn them in 3D", "viewer.html"),
    ("gallery", "gallery.png"),
    ("how the best changed", STRIP),
    ("score curve", CURVE),
)
"""Words of the links at the end, and the files that they lead to where these exist."""

_log = logging.getLogger(__name__)


class NoLive:
    """Nobody looks: what is told is forgotten."""

    def __enter__(self) -> NoLive:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Do nothing."""

    def on_improvement(self, improvement: Improvement, objective: Objective) -> None:
        """Forget it."""

    def on_generation(self, generation: Generation) -> None:
        """Forget it."""

    def searched(self) -> None:
        """Forget it."""


class Live(NoLive):
    """Page in `folder`. Use in `with`; whatever fails in it is said once and does not end the run."""

    def __init__(self, folder: Path, tree: ReadTree, title: str, total: int, asset: AssetSettings) -> None:
        self._folder, self._title, self._asset, self._seen = folder, title, asset, tree.colours
        self._width = 2 * round(HEIGHT * ratio_for(1.15 * place(tree.extraction.mask).reach) / 2)
        self._given = given_panels(tree.picture.rgb, tree.extraction.mask, HEIGHT, self._width)
        resume = f"python run.py resume={shlex.quote(str(folder))}"
        self._moment = Moment(BEGINNING, True, patience=PATIENCE, total=total, resume=resume)
        self._history = read_history(folder / "history.jsonl")  # of a run that goes on
        self._best: tuple[Improvement, Objective] | None = None
        self._drawn: tuple[Improvement, Addresses] | None = None
        self._tried: Improvement | None = None
        self._draw_at, self._failed = 0.0, False
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._work, name="live", daemon=True)

    def __enter__(self) -> Live:
        self._safely(self._write_page)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._ended.set()
        self._thread.join()
        self._end(error)

    def on_improvement(self, improvement: Improvement, objective: Objective) -> None:
        """Take note of a new best plant."""
        self._best = (improvement, objective)

    def on_generation(self, generation: Generation) -> None:
        """Take note of what the search has come to."""
        if (
            self._history and generation.number <= self._history[-1].number
        ):  # a killed run wrote on after its checkpoint
            self._history = [line for line in self._history if line.number < generation.number]
        self._history.append(generation)
        if len(self._history) > MOST_KEPT:
            self._history = [*self._history[:-1:2], generation]

    def searched(self) -> None:
        """Say that the search is over, and that the files are being written."""
        self._moment = replace(self._moment, state=WRITING)
        if self._draw_at < math.inf:
            self._draw_at = 0.0

    def _work(self) -> None:
        told: object = None
        written = 0.0
        while not self._ended.wait(BETWEEN):
            news = (self._history[-1:], self._best, self._moment)
            if news == told and time.monotonic() < written + SILENCE:
                continue
            if time.monotonic() >= self._draw_at:
                self._safely(self._draw)
            self._safely(self._write_data)
            told, written = news, time.monotonic()

    def _draw(self) -> None:
        best = self._best
        if best is None or self._tried is best[0]:
            return
        improvement, objective = best
        self._tried = improvement
        begun = time.thread_time()
        try:
            plant = objective.grow(np.array(improvement.genome), objective.seed)
        except Exception as error:  # a foreign generator may fail now and then: the next plant is another one
            _log.debug("live page: not grown: %s", one_line(error))
            return
        first, self._draw_at = self._drawn is None, math.inf  # where one plant cannot be drawn, none is tried again
        self._drawn = improvement, embedded(drawn_panels(plant, self._asset, HEIGHT, self._width, self._seen))
        rest = 0.0 if first else (time.thread_time() - begun) / SHARE  # the first one has kernels to load
        self._draw_at = time.monotonic() + rest

    def _now(self) -> Moment:
        history = list(self._history)
        state = SEARCHING if self._moment.state == BEGINNING and history else self._moment.state
        found, panels = self._drawn or (None, None)
        return replace(self._moment, state=state, written=time.time(), history=history, best=panels, found=found)

    def _write_data(self) -> None:
        write_whole(self._folder / DATA, data_text(self._now()).encode())

    def _write_page(self) -> None:
        write_whole(self._folder / PAGE, page_text(self._title, self._folder.name, self._given, self._now()).encode())

    def _end(self, error: BaseException | None) -> None:
        """Write the page for good, with links to what came of the run; a page that is open hears of it by live.js."""
        if error is None and self._draw_at < math.inf:
            self._safely(self._draw)
        links = tuple((words, name) for words, name in LINKS if (self._folder / name).exists())
        self._moment = replace(self._moment, state=_how_it_ended(error), running=False, links=links)
        self._safely(self._write_page)
        self._safely(self._write_data)

    def _safely(self, act: Callable[[], None]) -> None:
        """Do `act`; the first time that anything fails is told, for the page is worth no run."""
        try:
            act()
        except Exception as error:
            _log.log(logging.DEBUG if self._failed else logging.WARNING, "live page: %s", one_line(error))
            self._failed = True


def _how_it_ended(error: BaseException | None) -> str:
    if error is None:
        return "done"
    return "stopped" if isinstance(error, KeyboardInterrupt) else f"failed: {one_line(error)}"
