"""Pictures of the program's pages for the README: makes a few runs of the example pictures and looks at them.

    python -m scripts.take_screenshots [--evaluations 10000] [--folder experiments/figures]

Needs Chromium; takes some three minutes on two cores.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from scripts.headless_browser import BrowserError, HeadlessBrowser, find_browser
from scripts.screenshot_pages import BEFORE, UNFOLD, Page, take
from treefit.tracking.addresses import file_page, run_page
from treefit.tracking.kept_run import run_of
from treefit.tracking.local_store import LocalStore
from treefit.tracking.server import Server, find_runs_page

ROOT = Path(__file__).parents[1]
SWEEP = ("-m", "image=pine.png,oak.png", "generator=simplegen,weberpenn,gegen")
WATCHED = ("image=oak.png", "generator=gegen", "live=true")
WATCHED_FROM = 0.4
"""Share of the search after which its page is looked at."""

EXPERIMENT = "1"


def main() -> int:
    """Make the runs, take the pictures; 2 when there is no browser."""
    options = _options()
    try:
        find_browser()
        with tempfile.TemporaryDirectory(prefix="treefit_pages_") as scratch:
            _take_all(Path(scratch), options.evaluations, options.folder)
    except BrowserError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


def _take_all(scratch: Path, evaluations: int, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    store = LocalStore(scratch / "mlflow.db")
    common = (f"optimizer.evaluations={evaluations}", f"tracking.uri={store.uri}")
    with HeadlessBrowser(1280, 800, BEFORE) as browser:
        _watch(browser, scratch / "watched", folder, evaluations, *common)
        print(f"a sweep of six runs, {evaluations:,} evaluations each ...", flush=True)
        _run(*SWEEP, *common, f"hydra.sweep.dir={scratch / 'sweep'}").wait()
        run = max(sorted((scratch / "sweep").glob("*_pine")), key=_candidates)
        said = take(browser, Page("page_viewer.png", (run / "viewer.html").as_uri(), CANVAS, (1280, 860), 5), folder)
        _say(said)
        with Server(store, scratch / "server.log") as server:
            for page in _pages(server.address, scratch / "sweep", run):
                _say(take(browser, page, folder))


CANVAS = "document.querySelector('canvas')"


def _watch(browser: HeadlessBrowser, run: Path, folder: Path, evaluations: int, *common: str) -> None:
    """Look at the page of a run while it searches."""
    process = _run(*WATCHED, *common, f"hydra.run.dir={run}")
    try:
        while process.poll() is None and _tried(run / "history.jsonl") < WATCHED_FROM * evaluations:
            time.sleep(0.2)
        if not (run / "live.html").is_file():
            raise BrowserError("the watched run did not begin: see what it said above")
        drawn = "[...document.images].every(one => one.naturalWidth)"
        _say(take(browser, Page("page_live.png", (run / "live.html").as_uri(), drawn, (1280, 760)), folder))
    finally:
        process.wait()


def _candidates(run: Path) -> int:
    """Trees that a run ended with."""
    return len([*run.glob("candidates/*/tree.glb")])


def _tried(history: Path) -> int:
    """Evaluations that a run has done."""
    lines = history.read_text(encoding="utf-8").split("\n")[:-1] if history.is_file() else []
    return int(json.loads(lines[-1])["evaluations"]) if lines else 0


def _pages(address: str, sweep: Path, run: Path) -> list[Page]:
    """Pages of mlflow: all runs, one run, its candidates and its viewer, the sweep and its table."""

    def page(place: str) -> str:
        return f"{address}/{place}"

    runs, one, parent = find_runs_page(address, "treefit"), run_of(run), run_of(sweep)
    if runs is None or one is None or parent is None:
        raise BrowserError("the runs were not kept: see what they said above")
    glance = "document.querySelector('img[src*=glance]')?.complete"
    table = "document.querySelectorAll('img[src^=blob], img[src*=table_images]').length > 0"
    return [
        Page("mlflow_runs.png", runs, "document.querySelector('[data-component-id*=runnamecellrenderer]')", (1380, 640),
             then=UNFOLD),
        Page("mlflow_run.png", page(run_page(EXPERIMENT, one)), glance, (1280, 720)),
        Page("mlflow_candidates.png", page(file_page(EXPERIMENT, one, "candidates_table.json")), table, (1280, 800)),
        Page("mlflow_viewer.png", page(file_page(EXPERIMENT, one, "viewer.html")), "document.querySelector('iframe')",
             (1380, 900), 8),
        Page("mlflow_sweep.png", page(run_page(EXPERIMENT, parent)), glance, (1280, 720)),
        Page("mlflow_sweep_table.png", page(file_page(EXPERIMENT, parent, "sweep_table.json")), table, (1380, 640)),
    ]  # fmt: skip


def _run(*settings: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen([sys.executable, "run.py", *settings], cwd=ROOT, stdout=subprocess.DEVNULL)


def _say(file: Path) -> None:
    print(f"{file}  {file.stat().st_size // 1000} kB", flush=True)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--evaluations", type=int, default=10000, help="of every run")
    parser.add_argument("--folder", type=Path, default=ROOT / "experiments" / "figures", help="where pictures go")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
