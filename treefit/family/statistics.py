"""Statistics of a family of objective functions (sec. 5): how much each gene matters, where in it good plants are."""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from treefit.family.identity import FamilyError, Gene, StaleError, describe, fingerprint
from treefit.plant import Generator, ParameterSpace

Floats = NDArray[np.float64]
Counts = NDArray[np.int64]
Mark = Literal["continuous", "paper"]

WORST = 9.9
"""Farthest mark from 0, the authors' for a part of a gene in which nothing good was found."""

FORMAT = 1


@dataclass(frozen=True, eq=False)
class Statistics:
    """What was counted over many plants and targets, for one generator (name and version) and one similarity.

    `genes`: descriptions of the n genes; `rate` (n,): V(k), mean change of the score by that of the gene; `steps` (n,):
    pairs of plants behind it; `tried`, `above` (n, k): evaluations with gene i in the j-th of k equal parts of [0, 1],
    and those of them that scored over eps; `eps` (t,): that score, target by target.
    """

    generator: str
    version: str
    similarity: str
    genes: tuple[Gene, ...]
    rate: Floats
    steps: Counts
    tried: Counts
    above: Counts
    eps: Floats

    def __post_init__(self) -> None:
        n = len(self.genes)
        if any(not isinstance(gene.get("name"), str) for gene in self.genes) or len(set(self.names)) != n or n == 0:
            raise ValueError("genes must have names that differ from each other")
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
    def names(self) -> tuple[str, ...]:
        """Names of the genes, in order."""
        return tuple(str(gene["name"]) for gene in self.genes)

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
        changed = self.changed(space)
        if changed:
            raise StaleError(f"parameter {changed[0]!r} has another range now", self.generator)
        at = [self.names.index(name) if name in self.names else len(self.genes) for name in space.names]
        rate = np.append(self.rate, self.rate.mean())
        quality = self.quality(mark)
        return rate[at], np.vstack([quality, np.zeros(quality.shape[1])])[at]

    def changed(self, space: ParameterSpace) -> list[str]:
        """Names of the genes of `space` that are described otherwise here."""
        known = dict(zip(self.names, self.genes, strict=True))
        return [gene.name for gene in space.free if gene.name in known and known[gene.name] != describe(gene)]

    def write(self, path: Path) -> None:
        """Write an npz without pickle, at once or not at all."""
        head = {"format": FORMAT, "generator": self.generator, "version": self.version, "similarity": self.similarity,
                "genes": self.genes}  # fmt: skip
        text = np.frombuffer(json.dumps(head, allow_nan=False).encode(), np.uint8)
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_name(path.name + ".tmp")
        with unfinished.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, head=text, rate=self.rate, steps=self.steps,
                                tried=self.tried, above=self.above, eps=self.eps)  # fmt: skip
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(path)

    @classmethod
    def read(cls, path: Path) -> Statistics:
        """Statistics in `path`; FamilyError when the file is damaged, FileNotFoundError when there is none."""
        try:
            with np.load(path, allow_pickle=False) as file:
                head: Any = json.loads(bytes(file["head"]).decode())
                if head["format"] != FORMAT:
                    raise ValueError(f"format {head['format']!r}, not {FORMAT}")
                name, version, similarity = (str(head[key]) for key in ("generator", "version", "similarity"))
                steps, tried, above = (_array(file, key, np.int64) for key in ("steps", "tried", "above"))
                rate, eps = (_array(file, key, np.float64) for key in ("rate", "eps"))
            genes = tuple(dict(gene) for gene in head["genes"])
            return cls(name, version, similarity, genes, rate, steps, tried, above, eps)
        except FileNotFoundError:
            raise
        except (OSError, ValueError, TypeError, KeyError, EOFError, NotImplementedError, zipfile.BadZipFile,
                zlib.error) as error:  # fmt: skip
            why = " ".join(str(error).split()) or type(error).__name__
            raise FamilyError(f"statistics {path}: damaged ({why}); delete the file") from error


def find_statistics(generator: Generator, similarity: object) -> Statistics | None:
    """Statistics in `generator.family` (statistics*.npz) for this `similarity` and space, those of the most like space.

    None when there are none: no files, or for other similarities (weights that the user changed), or for another space
    of the generator (genes that the file does not know, and other ranges). StaleError when all that would fit are of
    another version of the generator or of other ranges; FamilyError for a damaged file.
    """
    if generator.family is None:
        return None
    found, stale = [], []
    space, wanted = generator.space, fingerprint(similarity)
    for path in sorted(generator.family.glob("statistics*.npz")):
        one = Statistics.read(path)
        if one.generator != generator.name or one.similarity != wanted:
            continue
        changed = one.changed(space)
        unknown = set(space.names) - {*one.names, str(generator.size_parameter)}
        if one.version != generator.version:
            stale.append(f"{path.name} is of version {one.version}, the generator of {generator.version}")
        elif changed and not unknown:
            stale.append(f"parameter {changed[0]!r} has another range than in {path.name}")
        elif not changed:
            found.append((len(set(space.names) ^ set(one.names)), path.name, one))
    if stale and not found:
        raise StaleError(stale[0], generator.name)
    return min(found, key=lambda candidate: candidate[:2])[2] if found else None


def _array(file: Any, name: str, kind: type[np.generic]) -> NDArray[Any]:
    array = file[name]
    if array.dtype != kind:
        raise ValueError(f"{name} must be {kind.__name__}, got {array.dtype}")
    return np.asarray(array)
