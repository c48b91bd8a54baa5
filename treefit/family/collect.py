"""Collecting: what many random plants score for all members of a family becomes statistics (sec. 5)."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from treefit.family.batch import Batch, genes, keep_arrays, kept_arrays
from treefit.family.identity import describe, fingerprint
from treefit.family.members import Members
from treefit.family.statistics import Counts, Floats, Statistics
from treefit.mask import Mask

FARTHEST, NEAREST = 0.2, 0.01
"""How far a gene is moved for V(k), the authors' 0.2 at most; a leap of the score by less would outweigh all others."""


@dataclass(frozen=True, eq=False)
class Moved:
    """Sums over pairs of plants that differ in one gene: change of the score by that of the gene (n,), and counts."""

    change: Floats
    steps: Counts


def thresholds(batches: Sequence[Batch], share: float, eps: float | None) -> Floats:
    """Score (t,) over which a plant is good, target by target: `eps`, or what a `share` of the plants exceed."""
    scores = np.concatenate([batch.scores for batch in batches]).astype(np.float64)
    if eps is not None:
        return np.full(scores.shape[1], eps)
    return np.quantile(scores, 1 - share, axis=0)


def count(batches: Sequence[Batch], eps: Floats, parts: int) -> tuple[Counts, Counts]:
    """Evaluations by gene and part (n, parts), and those of them that scored over `eps` (t,)."""
    n, t = batches[0].genomes.shape[1], len(eps)
    tried, above = np.zeros((n, parts), np.int64), np.zeros((n, parts), np.int64)
    for batch in batches:
        good = (batch.scores > eps).sum(axis=1)
        part = np.minimum((genes(batch.genomes) * parts).astype(np.intp), parts - 1)
        for i in range(n):
            tried[i] += t * np.bincount(part[:, i], minlength=parts)
            above[i] += np.bincount(part[:, i], good, parts).astype(np.int64)
    return tried, above


def good_plants(batches: Sequence[Batch], eps: Floats, most: int, seed: int) -> NDArray[np.int64]:
    """Pairs (m, 2) of batch and row: at most `most` plants that are over `eps` for a target, drawn at random."""
    found = [(i, int(row)) for i, batch in enumerate(batches) for row in np.flatnonzero((batch.scores > eps).any(1))]
    chosen = np.random.default_rng([seed, 2]).permutation(len(found))[:most]
    return np.array(found, np.int64).reshape(-1, 2)[np.sort(chosen)]


def move(members: Members, genome: NDArray[np.uint16], on: int, scores: NDArray[np.float32], eps: Floats,
         seed: tuple[int, ...]) -> Moved:  # fmt: skip
    """Move each gene of a plant with `scores` (t,) on seed `on` by 0.01 to 0.2, either way (sec. 5).

    The change is the mean of |f(x + h e_k) - f(x)| / |h| over the targets for which the plant is over `eps` (t,): in
    size, for changes up and down would cancel out.
    """
    rng = np.random.default_rng(seed)
    start, good = genes(genome), scores > eps
    n = len(start)
    change = np.zeros(n)
    for k, h in enumerate(rng.uniform(NEAREST, FARTHEST, n) * rng.choice([-1.0, 1.0], n)):
        moved = start.copy()
        moved[k] += h if 0 <= moved[k] + h <= 1 else -h
        other = members(moved, on).scores.astype(np.float64)
        change[k] = np.abs(other - scores)[good].mean() / abs(h)
    return Moved(change, np.ones(n, np.int64))


def total(moved: Sequence[Moved]) -> Moved:
    """Sum of all that were `moved`."""
    return Moved(np.sum([one.change for one in moved], axis=0), np.sum([one.steps for one in moved], axis=0))


def keep_moved(path: Path, moved: Moved, digest: str) -> None:
    """Write `moved` to `path`, at once or not at all."""
    keep_arrays(path, vars(moved), digest)


def kept_moved(path: Path, digest: str) -> Moved | None:
    """Moved genes in `path`; None when there are none, or of other plants."""
    arrays = kept_arrays(path, ["change", "steps"])
    return Moved(arrays["change"], arrays["steps"]) if arrays and arrays["digest"] == digest else None


def statistics_of(
    members: Members, batches: Sequence[Batch], eps: Floats, parts: int, moved: Sequence[Moved]
) -> Statistics:
    """Statistics of `batches` and of the genes that were `moved`."""
    tried, above = count(batches, eps, parts)
    whole = total(moved)
    rate, steps = whole.change / np.maximum(whole.steps, 1), whole.steps
    genes = tuple(describe(gene) for gene in members.space.free)
    tied = members.generator.name, members.generator.version, genes
    return Statistics(*tied, fingerprint(members.similarity), rate, steps, tried, above, eps)


def digest_of(members: Members, masks: Sequence[Mask], seed: int) -> str:
    """Hash of everything that the scores of plants for `masks` depend on, for files of a collection."""
    told = (members.generator.name, members.generator.version, members.space, members.view, members.frame,
            members.similarity, members.wishes, members.budget, seed, [mask.shape for mask in masks])  # fmt: skip
    return hashlib.sha256(repr(told).encode() + b"".join(mask.tobytes() for mask in masks)).hexdigest()
