"""Calibration: how well marks foretell which plants are good, on plants that were not counted for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import rankdata, spearmanr

from treefit.family.batch import Batch, genes
from treefit.family.statistics import Floats, Mark, Statistics

FEW = 100
"""Evaluations under which a share of good ones is not told."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """Marks Q(G) (m,) of plants and how many of the t targets each is good for, `good` (m,)."""

    marks: Floats
    good: Floats
    targets: int

    @property
    def rank_correlation(self) -> float:
        """Spearman's correlation of the mark of a plant and the count of targets for which it is good."""
        return float(spearmanr(self.marks, self.good).statistic) if np.ptp(self.marks) and np.ptp(self.good) else 0.0

    @property
    def area(self) -> float:
        """Chance that of a good and a bad evaluation the good one has the higher mark: 0.5 without any knowledge."""
        marks, good = np.repeat(self.marks, self.targets), self.good.astype(np.intp)
        is_good = (np.arange(self.targets) < good[:, None]).ravel()
        hits, misses = int(is_good.sum()), int((~is_good).sum())
        if hits == 0 or misses == 0:
            return 0.5
        return float((rankdata(marks)[is_good].sum() - hits * (hits + 1) / 2) / (hits * misses))

    def lift(self, share: float) -> float:
        """How many times as often as the mean the `share` of the plants with the highest marks are good."""
        best = np.argsort(-self.marks, kind="stable")[: max(round(share * len(self.marks)), 1)]
        mean = self.good.mean()
        return float(self.good[best].mean() / mean) if mean > 0 else 1.0

    def curve(self, width: float = 1.0) -> tuple[Floats, Floats, Floats]:
        """Marks at the middles of parts of `width`, P(f > eps) there, and the evaluations behind each, 100 at least."""
        part = np.floor(self.marks / width).astype(np.int64)
        found = [(part == one).nonzero()[0] for one in np.unique(part)]
        kept = [rows for rows in found if len(rows) * self.targets >= FEW]
        middle = [(part[rows[0]] + 0.5) * width for rows in kept]
        chance = [self.good[rows].mean() / self.targets for rows in kept]
        return np.array(middle), np.array(chance), np.array([len(rows) * self.targets for rows in kept], float)


def calibrate(statistics: Statistics, fresh: Sequence[Batch], mark: Mark) -> Calibration:
    """Calibration of the marks of `statistics` on `fresh` plants."""
    quality = statistics.quality(mark)
    n, k = quality.shape
    genomes = np.concatenate([genes(batch.genomes) for batch in fresh])
    part = np.minimum((genomes * k).astype(np.intp), k - 1)
    scores = np.concatenate([batch.scores for batch in fresh])
    good = (scores > statistics.eps).sum(axis=1)
    return Calibration(quality[np.arange(n), part].sum(axis=1), good.astype(np.float64), scores.shape[1])
