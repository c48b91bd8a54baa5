"""Statistics of a family of objective functions (sec. 5): how much each gene matters, where in it good plants are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from treefit.family.files import array, read_arrays, write_arrays
from treefit.family.identity import Tied, fingerprint, fitting
from treefit.plant import Generator, ParameterSpace

Floats = NDArray[np.float64]
Counts = NDArray[np.int64]
Mark = Literal["continuous", "paper"]

WORST = 9.9
"""Farthest mark from 0, the authors' for a part of a gene in which nothing good was found."""

KINDS: Mapping[str, type[np.generic]] = {
    "rate": np.float64, "steps": np.int64, "tried": np.int64, "above": np.int64, "eps": np.float64,
}  # fmt: skip
"""Arrays of a file, and of what numbers they are."""


@dataclass(frozen=True, eq=False)
class Statistics(Tied):
    """What was counted over many plants and targets, for one generator and one similarity.

    `rate` (n,): V(k), mean change of the score by that of the gene; `steps` (n,):
    pairs of plants behind it; `tried`, `above` (n, k): evaluations with gene i in the j-th of k equal parts of [0, 1],
    and those of them that scored over eps; `eps` (t,): that score, target by target.
    """

    similarity: str
    rate: Floats
    steps: Counts
    tried: Counts
    above: Counts
    eps: Floats

    def __post_init__(self) -> None:
        super().__post_init__()
        n = len(self.genes)
        if self.rate.shape != (n,) or self.steps.shape != (n,):
            raise ValueError(f"rate and steps must be of {n} genes, got {self.rate.shape} and {self.steps.shape}")
        if (
            self.tried.ndim != 2
            or len(self.tried) != n
            or self.tried.shape[1] == 0
            or self.above.shape != self.tried.shape
        ):
            raise ValueError(
                f"tried and above must have the shape ({n}, k), got {self.tried.shape}, {self.above.shape}"
            )
        if not (np.isfinite(self.rate).all() and (self.rate >= 0).all() and (self.steps >= 0).all()):
            raise ValueError("rates must be finite and not negative, steps not negative")
        if not ((self.above >= 0) & (self.above <= self.tried)).all():
            raise ValueError("above must be in [0, tried]")
        if len(set(self.tried.sum(axis=1))) != 1 or len(set(self.above.sum(axis=1))) != 1 or self.evaluations == 0:
            raise ValueError("every gene must have been counted in the same evaluations")
        if self.eps.ndim != 1 or not np.isfinite(self.eps).all():
            raise ValueError("eps must be a finite number for every target")

    @property
    def evaluations(self) -> int:
        """Count of evaluations."""
        return int(self.tried[0].sum())

    @property
    def p0(self) -> float:
        """P0 = P(f > eps) (sec. 5)."""
        return float(self.above[0].sum() / self.evaluations)

    @property
    def chance(self) -> Floats:
        """P(i, j) = P(f > eps | gene i in part j) (n, k) (sec. 5); P0 where nothing was tried."""
        return np.asarray(np.where(self.tried > 0, self.above / np.maximum(self.tried, 1), self.p0))

    def quality(self, mark: Mark = "continuous") -> Floats:
        """Q(i, j) (n, k), in [-9.9, 9.9].

        "paper": sgn(P - P0) max(P, P0) / min(P, P0) (sec. 5), which leaps from -1 to 1 at P0, so that noise of a gene
        that does not matter is a mark; "continuous": P / P0 - 1 over P0, 1 - P0 / P under it.
        """
        if self.p0 == 0:
            return np.zeros(self.tried.shape)
        by = self.chance / self.p0
        with np.errstate(divide="ignore"):
            size = np.where(by >= 1, by, 1 / by) - (0 if mark == "paper" else 1)
        marks: Floats = np.clip(np.sign(by - 1) * size, -WORST, WORST)
        return marks

    def for_space(self, space: ParameterSpace, mark: Mark = "continuous") -> tuple[Floats, Floats]:
        """V (n,) and Q (n, k) of the genes of `space`; those that are not known have the mean rate and marks of 0.

        StaleError when a gene had another range or kind.
        """
        at = self.places(space)
        rate = np.append(self.rate, self.rate.mean())
        quality = self.quality(mark)
        return rate[at], np.vstack([quality, np.zeros(quality.shape[1])])[at]

    def write(self, path: Path) -> None:
        """Write to `path`, at once or not at all."""
        head = {name: getattr(self, name) for name in ("generator", "version", "similarity", "genes")}
        write_arrays(path, head, {name: getattr(self, name) for name in KINDS})

    @classmethod
    def read(cls, path: Path) -> Statistics:
        """Statistics in `path`; FamilyError when the file is damaged, FileNotFoundError when there is none."""
        return read_arrays(path, "statistics", cls._made)

    @classmethod
    def _made(cls, head: Any, arrays: Mapping[str, NDArray[Any]]) -> Statistics:
        numbers = {name: array(arrays, name, kind) for name, kind in KINDS.items()}
        genes = tuple(map(dict, head["genes"]))
        return cls(str(head["generator"]), str(head["version"]), genes, str(head["similarity"]), **numbers)


def find_statistics(generator: Generator, similarity: object) -> Statistics | None:
    """Statistics in `generator.family` (statistics*.npz) for this `similarity` and space, those of the most like space.

    None when there are none: no files, or for other similarities (weights that the user changed), or for another space
    of the generator (genes that the file does not know, and other ranges). StaleError when all that would fit are of
    another version of the generator or of other ranges; FamilyError for a damaged file.
    """
    if generator.family is None:
        return None
    files = sorted(generator.family.glob("statistics*.npz"))
    read = ((path.name, Statistics.read(path)) for path in files)
    return fitting([each for each in read if each[1].similarity == fingerprint(similarity)], generator)
