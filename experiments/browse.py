"""Task browse: the pages of all runs, with their pictures and scores, until Ctrl-C."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import webbrowser
from pathlib import Path
from types import FrameType

from omegaconf import DictConfig

from experiments.browse_settings import BrowseSettings
from experiments.errors import UserError, one_line
from experiments.run_folder import discard, run_folder
from experiments.settings import read_settings
from treefit.tracking.local_store import LocalStore, find_store
from treefit.tracking.server import Server, ServerError, find_runs_page

FIRST_RUN = "make one first, e.g. python run.py image=pine.png"


def run(cfg: DictConfig) -> None:
    """Serve the runs of cfg.tracking and say where; UserError when there are none."""
    _leave_no_folder(run_folder())
    if "uri" not in cfg.tracking:
        raise UserError("browse: tracking=none keeps no runs; leave it out, or give tracking.uri=...")
    settings = read_settings(cfg).browse
    store, experiment = find_store(cfg.tracking.uri), str(cfg.tracking.experiment)
    if isinstance(store, str):
        _show(_page(store, experiment), settings)
        return
    if not store.database.is_file():
        raise UserError(f"browse: no runs are kept in {store.database}; {FIRST_RUN}, or give tracking.uri=...")
    for ending in (signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
        signal.signal(ending, _interrupt)
    try:
        _serve(store, experiment, settings)
    except KeyboardInterrupt:
        print(file=sys.stderr)


def _serve(store: LocalStore, experiment: str, settings: BrowseSettings) -> None:
    """Show the pages until Ctrl-C or until the server ends."""
    with tempfile.TemporaryDirectory(prefix="treefit_browse_") as scratch:
        try:
            print("starting the pages, some seconds ...", file=sys.stderr, flush=True)
            with Server(store, Path(scratch) / "server.log", settings.port) as server:
                _show(_page(server.address, experiment), settings)
                print("Ctrl-C ends it", file=sys.stderr, flush=True)
                server.wait()
                raise ServerError("the server has ended")
        except ServerError as error:
            raise UserError(f"browse: {one_line(error)}") from error


def _page(address: str, experiment: str) -> str:
    try:
        page = find_runs_page(address, experiment)
    except ServerError as error:
        raise UserError(f"tracking.uri: {one_line(error)}") from error
    if page is None:
        raise UserError(f"tracking.experiment: no runs under the name {experiment!r}; {FIRST_RUN}")
    return page


def _show(page: str, settings: BrowseSettings) -> None:
    print(f"runs     {page}", flush=True)
    if settings.open is True or (settings.open == "auto" and _has_display()):
        webbrowser.open(page)


def _has_display() -> bool:
    """Whether a browser would be seen here: not on a server that somebody is logged in to from elsewhere."""
    if sys.platform in ("win32", "darwin"):
        return not os.environ.get("SSH_CONNECTION")
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _leave_no_folder(folder: Path) -> None:
    """Remove the folder that every task begins with: looking leaves nothing behind."""
    (folder / "config.yaml").unlink(missing_ok=True)
    discard(folder)
