"""Table of hostile generators: what a search makes of a program that misbehaves in a tenth, or in all, of its calls.

python -m scripts.hostile_table [--kinds hang segfault] [--millis 20] [--evaluations 600] [--timeout 1] [--shares 0.1 1]

Each row is measured against a search with the same program when it behaves, before and after it. `--millis` is the time
that a tree takes. Nobody else should be at work on the machine.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
import uuid
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import psutil

from experiments.markdown import LEFT, table
from generators.external import External
from treefit import CMAES, Characteristics, fit
from treefit.image import AutoMask, read_picture
from treefit.mask import Mask
from treefit.progress import Failure, Generation
from treefit.regrowth import SearchError

ROOT = Path(__file__).parents[1]
PROGRAM = ROOT / "tests" / "generators" / "external" / "tree_program.py"
SPACE = PROGRAM.parent / "hostile" / "space.yaml"
PICTURE = ROOT / "experiments" / "images" / "pine.png"
MARK = "HOSTILE_TABLE"
ON_DEMAND = ("bare_daemon", "litter_here")
"""Kinds whose leavings nobody can know as theirs: they would stay on the machine."""
HEAD = ("kind", "what it does", "share", "events", "told as", "evaluations/s", "of the rate when well", "score",
        "seconds", "processes left", "files left")  # fmt: skip
SIDES = (LEFT, LEFT, "---:", "---:", LEFT, *["---:"] * 6)


@dataclass(frozen=True)
class Outcome:
    """How one search went: events by what was told of them, and the rest of a row."""

    events: Counter[str]
    rate: float
    score: float
    seconds: float
    processes: int
    files: int
    end: str = ""


def main() -> None:
    options = _options()
    told = _kinds()
    mask, rows = AutoMask()(read_picture(PICTURE)).mask, []
    search(mask, "well", 0.0, options)  # what is compiled first
    for share in options.shares:
        for kind in options.kinds or [kind for kind in told if kind not in ON_DEMAND]:
            before = search(mask, "well", 0.0, options)
            found = search(mask, kind, share, options)
            after = search(mask, "well", 0.0, options)
            rows.append(_row(kind, told[kind], share, found, (before.rate + after.rate) / 2))
            print(*rows[-1], sep=" | ", file=sys.stderr, flush=True)
    print(*table(HEAD, rows, SIDES), sep="\n")


def search(mask: Mask, kind: str, share: float, options: argparse.Namespace) -> Outcome:
    """Search with a program that misbehaves as `kind` says in a `share` of its calls."""
    events: Counter[str] = Counter()
    last: list[Generation] = []

    def listen(generation: Generation, failures: list[Failure]) -> None:
        last[:] = [generation]
        events.update(_without_numbers(failure.reason) for failure in failures)

    how = ("--how", kind, "--share", str(share), "--millis", str(options.millis))
    with _room() as (folder, mark):
        generator = External(
            command=[sys.executable, str(PROGRAM), *how], space=SPACE, timeout=options.timeout, memory=options.memory
        )
        began, end, score = time.perf_counter(), "", 0.0
        try:
            result = fit(mask, generator, optimizer=CMAES(evaluations=options.evaluations, start="random"),
                         characteristics=Characteristics(vertices=None), candidates=1, other_seeds=0,
                         on_generation=listen)  # fmt: skip
            score = result.candidates[0].score.total if result.candidates else 0.0
        except SearchError as error:
            end = str(error)
        seconds = time.perf_counter() - began
        generator.close()
        rate = last[0].evaluations_per_second if last else 0.0
        return Outcome(events, rate, score, seconds, len(_processes(mark)), len(list(folder.rglob("*"))), end)


def _row(kind: str, does: str, share: float, found: Outcome, well: float) -> list[str]:
    reason = found.end or (found.events.most_common(1)[0][0] if found.events else "nothing")
    return [
        kind, does.rstrip("."), f"{share:.0%}", str(found.events.total()), reason[:160].replace("|", "/"),
        f"{found.rate:.0f}", f"{found.rate / well:.2f}", f"{found.score:.3f}", f"{found.seconds:.1f}",
        str(found.processes), str(found.files),
    ]  # fmt: skip


@contextmanager
def _room() -> Iterator[tuple[Path, str]]:
    """Folder for all temporary files, and a mark by which all processes of a search are known."""
    mark = uuid.uuid4().hex
    with tempfile.TemporaryDirectory() as name:
        known = os.environ.get("TMPDIR")
        os.environ["TMPDIR"] = tempfile.tempdir = name
        os.environ[MARK] = mark
        try:
            yield Path(name), mark
        finally:
            tempfile.tempdir = None
            del os.environ["TMPDIR"], os.environ[MARK]
            if known is not None:
                os.environ["TMPDIR"] = known


def _processes(mark: str) -> list[psutil.Process]:
    found = []
    for process in psutil.process_iter():
        with suppress(psutil.Error):
            if process.environ().get(MARK) == mark and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
    return [*found, *(one for one in psutil.Process().children() if one.status() == psutil.STATUS_ZOMBIE)]


def _without_numbers(reason: str) -> str:
    """Return a reason as it is told, without what differs from call to call."""
    return reason.replace(tempfile.gettempdir(), "")


def _kinds() -> dict[str, str]:
    told = subprocess.run([sys.executable, str(PROGRAM), "--list"], capture_output=True, text=True, check=True)
    return dict(json.loads(told.stdout))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kinds", nargs="*", help="ways to misbehave, all when left out")
    parser.add_argument("--shares", nargs="*", type=float, default=[0.1], help="shares of calls that are bad")
    parser.add_argument("--millis", type=float, default=0.0, help="CPU time of a tree")
    parser.add_argument("--evaluations", type=int, default=600)
    parser.add_argument("--timeout", type=float, default=1.0)
    parser.add_argument("--memory", type=float, default=0.5, help="GiB")
    return parser.parse_args()


if __name__ == "__main__":
    main()
