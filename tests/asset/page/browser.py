"""Headless Chromium for the tests of pages; they are skipped with the reason where there is none."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# virtual time is that of one process, and frames would have their own
_FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic",
          "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
          "--enable-logging=stderr", "--window-size=1000,700", "--virtual-time-budget=6000",
          "--disable-features=IsolateSandboxedIframes")  # fmt: skip

needs_browser = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")


def browse(page: Path, *flags: str, hash: str = "") -> tuple[str, list[str]]:
    """Open `page` and return what is written to stdout and the messages of its console."""
    command = [str(CHROMIUM), *_FLAGS, f"--user-data-dir={page.parent / 'profile'}", *flags, f"{page.as_uri()}{hash}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    messages = re.findall(r'CONSOLE:\d+\] "(.*?)", source:', done.stderr, re.DOTALL)
    return done.stdout, [words for words in messages if "GPU stall" not in words]
