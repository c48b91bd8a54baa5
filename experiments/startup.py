"""Seconds from the start of a process to its first evaluation, without and with compiled kernels in numba's cache."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).parents[1]


def first_evaluation_seconds(config: Path) -> dict[str, float]:
    """Seconds on the clock with an empty cache and with a full one, of a process with the settings in `config`."""
    with TemporaryDirectory() as cache:
        return {"empty_cache": _seconds(config, cache), "cache": min(_seconds(config, cache) for _ in range(3))}


def _seconds(config: Path, cache: str) -> float:
    paths = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH", ""))))
    place = os.environ | {"NUMBA_CACHE_DIR": cache, "PYTHONPATH": paths}
    started = time.perf_counter()
    subprocess.run([sys.executable, "-m", "experiments.first_evaluation", str(config)], env=place, check=True)
    return time.perf_counter() - started
