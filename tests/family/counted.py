"""Small statistics for tests."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from generators.simplegen import SimpleGen
from treefit.family.identity import describe, fingerprint
from treefit.family.statistics import Statistics
from treefit.similarity import Mix


@dataclass(frozen=True)
class Counted(SimpleGen):
    """SimpleGen whose statistics are in a folder of the test."""

    family: Path | None = None


def statistics(generator: SimpleGen | None = None, **changes: object) -> Statistics:
    """Statistics of every gene of `generator`, all the same but for the rates 0, 1, 2 ..."""
    genes = tuple(describe(gene) for gene in (generator or SimpleGen()).space.free)
    n = len(genes)
    tried, above = np.tile([50, 50], (n, 1)), np.tile([2, 8], (n, 1))
    name, version = SimpleGen.name, SimpleGen.version
    found = Statistics(name, version, genes, fingerprint(Mix()), np.arange(n, dtype=float),
                       np.ones(n, np.int64), tried, above, np.array([0.3, 0.4]))  # fmt: skip
    return replace(found, **changes)  # type: ignore[arg-type]
