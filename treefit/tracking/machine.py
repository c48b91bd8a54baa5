"""Machine: how busy processors and memory are, sampled now and then where the numbers of a run are kept."""

from __future__ import annotations

import time
from collections.abc import Mapping

FIRST, BETWEEN = 1.0, 5.0
"""Seconds before the first sample, and between samples, at least."""

MEGABYTE = 1 << 20


class Machine:
    """Load of the machine under the names that mlflow shows as system metrics; it never fails and never waits."""

    def __init__(self) -> None:
        self._next = time.monotonic() + FIRST
        self._broken = False
        self._read()  # the share of processor time is that since the last reading

    def sample(self) -> Mapping[str, float]:
        """Return the load now; nothing when the last sample is fresh or the machine does not tell."""
        now = time.monotonic()
        if self._broken or now < self._next:
            return {}
        self._next = now + BETWEEN
        return self._read()

    def _read(self) -> Mapping[str, float]:
        try:
            import psutil

            return {
                "system/cpu_utilization_percentage": float(psutil.cpu_percent(interval=None)),
                "system/system_memory_usage_percentage": float(psutil.virtual_memory().percent),
                "system/process_memory_megabytes": psutil.Process().memory_info().rss / MEGABYTE,
            }
        except Exception:  # whatever it is that a machine does not let be read, a run does without
            self._broken = True
            return {}
