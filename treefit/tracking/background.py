"""Background: work that must not keep the search waiting, done in order on one thread."""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue

Job = Callable[[], None]


class Background:
    """Does jobs one after another; the first that fails is told to `on_failure`, the rest are left out."""

    def __init__(self, name: str, on_failure: Callable[[Exception], None]) -> None:
        self._jobs: SimpleQueue[tuple[Job, bool] | None] = SimpleQueue()
        self._on_failure = on_failure
        self._failed = False
        # a daemon, so that a server which never answers cannot keep the program from ending
        self._thread = threading.Thread(target=self._work, name=name, daemon=True)
        self._thread.start()

    @property
    def failed(self) -> bool:
        """Whether a job failed."""
        return self._failed

    def do(self, job: Job, *, always: bool = False) -> None:
        """Do `job` when those before it are done; with `always` even after one of them failed."""
        self._jobs.put((job, always))

    def close(self, seconds: float) -> bool:
        """Wait up to `seconds` for the jobs; whether all are through. No job may be added after it."""
        self._jobs.put(None)
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def _work(self) -> None:
        while (entry := self._jobs.get()) is not None:
            job, always = entry
            if self._failed and not always:
                continue
            try:
                job()
            except Exception as error:  # whatever a foreign library raises, the run goes on
                if not self._failed:
                    self._failed = True
                    self._on_failure(error)
