"""Scratch: the folder in which foreign programs write, which is gone when they are."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

import psutil

_NAME = re.compile(r"treefit-(\d+)-")


def scratch_folder() -> Path:
    """Make a folder of this process below the system's for temporary files; what dead processes left goes."""
    _sweep(Path(tempfile.gettempdir()))
    return Path(tempfile.mkdtemp(prefix=f"treefit-{os.getpid()}-"))


def remove(folder: Path) -> None:
    """Remove `folder` with all that is in it, locked folders too, as far as that can be done."""
    shutil.rmtree(folder, ignore_errors=True)
    if folder.exists():
        for locked in [folder, *folder.rglob("*")]:
            with suppress(OSError):
                if locked.is_dir() and not locked.is_symlink():
                    locked.chmod(0o700)
        shutil.rmtree(folder, ignore_errors=True)


def _sweep(place: Path) -> None:
    with suppress(OSError):
        for folder in place.glob("treefit-*-*"):
            known = _NAME.match(folder.name)
            if known and not psutil.pid_exists(int(known[1])):
                remove(folder)
