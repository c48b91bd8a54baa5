"""Marks: foreign programs and all that they start are known by a variable of their environment."""

from __future__ import annotations

from contextlib import suppress

import psutil

MARK = "TREEFIT_CHILD"
"""Variable that a program hands to its children: by it those are found that left its group."""

ROUNDS = 5
"""How often is looked while new ones are found."""


def end_marked(mark: str, since: float) -> None:
    """Kill all processes whose mark begins with `mark` and that began after `since`, seconds of the clock."""
    for _ in range(ROUNDS):
        found = _marked(mark, since)
        for process in found:
            with suppress(psutil.Error):
                process.kill()
        if not found:
            return


def _marked(mark: str, since: float) -> list[psutil.Process]:
    found = []
    for process in psutil.process_iter():
        with suppress(psutil.Error, OSError):
            marked = process.create_time() >= since and process.environ().get(MARK, "").startswith(mark)
            if marked and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
    return found
