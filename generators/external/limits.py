"""Limits: what a foreign process may take of time, memory, disk and words."""

from __future__ import annotations

from dataclasses import dataclass

GIB = 2**30

START = 1.5
"""Seconds more that a process may take for its first tree: it has to start."""

WORDS = 16 * 2**20
"""Bytes that a process may print for one tree."""

BYTES_A_VERTEX = 1000
"""Bytes of a file for each vertex that it may have: an npz takes 50, a mesh with all its attributes some hundreds."""


@dataclass(frozen=True)
class Limits:
    """Seconds for a tree, bytes of memory of a process with its children, vertices and leaves of a tree."""

    timeout: float = 10.0
    memory: int = 4 * GIB
    max_vertices: int = 200_000

    @property
    def file(self) -> int:
        """Bytes that a file may have."""
        return 2**20 + BYTES_A_VERTEX * self.max_vertices
