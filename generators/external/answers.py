"""Answers: what a foreign program prints; the lines that answer a request, and the last words of all others."""

from __future__ import annotations

import json
import queue
import threading
from dataclasses import dataclass
from typing import IO, Any, TypeAlias

from generators.external.limits import WORDS

LONGEST = 2**20
"""Bytes of a line; what is longer is no answer."""

KEPT = 400
"""Characters of the last words that are told when something goes wrong."""

LATE = 0.1
"""Seconds in which what an ended program printed is read."""

Answer: TypeAlias = dict[str, Any]


@dataclass(frozen=True)
class Ended:
    """The output came to its end."""


@dataclass(frozen=True)
class TooMuch:
    """More than `limit` bytes came since the last request."""

    limit: int


class Answers:
    """Reads the output of one process in a thread of its own; `queue` has the answers as they come."""

    def __init__(self, limit: int = WORDS) -> None:
        self.queue: queue.SimpleQueue[Answer | Ended | TooMuch] = queue.SimpleQueue()
        self.ended = threading.Event()
        self._limit, self._seen, self._words = limit, 0, b""

    def begin(self) -> None:
        """Forget what was printed for earlier requests, or for none."""
        self._seen, self._words = 0, b""
        while not self.queue.empty():
            self.queue.get_nowait()
        if self.ended.is_set():
            self.queue.put(Ended())

    def read(self, stream: IO[bytes]) -> None:
        """Read `stream` to its end."""
        line, told = b"", False
        try:
            while chunk := stream.read(2**16):
                self._seen += len(chunk)
                if self._seen > self._limit:
                    if not told:
                        self.queue.put(TooMuch(self._limit))
                    told, line = True, b""
                    continue
                told = False
                whole, _, line = (line + chunk).rpartition(b"\n")
                self._take_all(whole)
                line = line[-LONGEST:]
            self._take(line)
        except (OSError, ValueError):
            pass
        finally:
            self.ended.set()
            self.queue.put(Ended())

    def last(self) -> Answer | Ended | TooMuch:
        """What a program that has ended still said: it may be on its way, or its children may hold the output open."""
        try:
            return self.queue.get(timeout=LATE)
        except queue.Empty:
            return Ended()

    def quoted(self) -> str:
        """Last words in a form that ends a sentence: ": it said ..."; "" when there were none."""
        lines = [line.strip() for line in self._words.decode("utf-8", "replace").splitlines() if line.strip()]
        return f"; its last words: {lines[-1][-KEPT:]}" if lines else ""

    def _take_all(self, lines: bytes) -> None:
        if b"{" in lines:
            for line in lines.split(b"\n"):
                self._take(line)
        elif lines.strip():  # a flood is not taken apart
            self._words = lines[-4 * KEPT :]

    def _take(self, line: bytes) -> None:
        answer = answer_in(line)
        if answer is not None:
            self.queue.put(answer)
        elif line.strip():
            self._words = line[-4 * KEPT :]


def answer_in(line: bytes) -> Answer | None:
    """Answer that `line` is or, where a program had printed without an end of line, ends with; None for none."""
    if len(line) > LONGEST or b"{" not in line:
        return None
    for start in dict.fromkeys((line.find(b"{"), line.rfind(b'{"id"'), line.rfind(b"{"))):
        if start < 0:
            continue
        try:
            found = json.loads(line[start:])
        except (ValueError, RecursionError):
            continue
        if isinstance(found, dict) and "id" in found and ("ok" in found):
            return found
    return None
