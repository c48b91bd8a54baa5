"""The collection of the task statistics: batches of plants and moved genes, in files that a killed run goes on from."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

import numpy as np

from experiments.terminal import counted
from treefit.evaluation import in_parallel
from treefit.family.batch import Batch, grow_batch, keep_batch, kept_batch
from treefit.family.collect import Moved, good_plants, keep_moved, kept_moved, move, total
from treefit.family.members import Members
from treefit.family.statistics import Floats

PLANTS = 500
"""Plants in a batch: some seconds of work."""

MOVES = 10
"""Good plants whose genes are moved in one task."""

Job = TypeVar("Job")
Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class Collection:
    """Collects for `members` into `folder`, whose files say by `digest` that they are of this collection."""

    members: Members
    folder: Path
    digest: str
    seed: int
    workers: int
    kind: str

    def plants(self, name: str, count: int, stream: int) -> list[Batch]:
        """`count` random plants of a random `stream` in batches, in files <name>_0000.npz ..."""
        sizes = [min(PLANTS, count - start) for start in range(0, count, PLANTS)]
        return self._all(partial(self._plants, name, stream), list(enumerate(sizes)), f"batches of {PLANTS} plants")

    def moves(self, batches: Sequence[Batch], eps: Floats, count: int) -> list[Moved]:
        """Genes of `count` good plants of `batches` moved, in files moved_000.npz ..."""
        chosen = good_plants(batches, eps, count, self.seed)
        digest = hashlib.sha256(self.digest.encode() + eps.tobytes() + chosen.tobytes()).hexdigest()
        jobs = []
        for number, start in enumerate(range(0, len(chosen), MOVES)):
            some = [(batches[i].genomes[row], int(batches[i].seeds[row]), batches[i].scores[row])
                    for i, row in chosen[start : start + MOVES].tolist()]  # fmt: skip
            jobs.append((number, some))
        return self._all(partial(self._moves, eps, digest), jobs, f"steps of {MOVES} plants with every gene moved")

    def _all(self, call: Callable[[Job], Found], jobs: Sequence[Job], what: str) -> list[Found]:
        results = in_parallel(call, jobs, self.workers, self.kind)
        return [next(results) for _ in counted(range(len(jobs)), what)]

    def _plants(self, name: str, stream: int, job: tuple[int, int]) -> Batch:
        number, count = job
        path = self.folder / f"{name}_{number:04}.npz"
        batch = kept_batch(path, count, self.digest)
        if batch is None:
            batch = grow_batch(self.members, count, (self.seed, stream, number))
            keep_batch(path, batch, self.digest)
        return batch

    def _moves(self, eps: Floats, digest: str, job: tuple[int, list[tuple[np.ndarray, int, np.ndarray]]]) -> Moved:
        number, plants = job
        path = self.folder / f"moved_{number:03}.npz"
        moved = kept_moved(path, digest)
        if moved is None:
            found = [move(self.members, *plant, eps, (self.seed, 3, number, i)) for i, plant in enumerate(plants)]
            moved = total(found)
            keep_moved(path, moved, digest)
        return moved
