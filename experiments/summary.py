"""Summary of a run: summary.json, read by other programs."""

from __future__ import annotations

from dataclasses import asdict
from importlib.metadata import version

from experiments.candidate_facts import level_facts, record
from experiments.read_tree import ReadTree
from treefit.asset import TreeFiles
from treefit.candidates import Candidate
from treefit.fit import Result
from treefit.plant import Generator

PACKAGES = ("treefit", "numpy", "numba")
"""Packages whose version may change a result."""


def summary(
    result: Result, generator: Generator, tree: ReadTree, seed: int, files: list[TreeFiles]
) -> dict[str, object]:
    """Facts of a run for summary.json; only seconds and evaluations_per_second differ between equal runs."""
    best = result.candidates[0]
    last = result.history[-1]
    return {
        "score": best.score.total,
        "image_similarity": best.score.image,
        "multipliers": dict(best.score.multipliers),
        "evaluations": last.evaluations,
        "seconds": last.seconds,
        "evaluations_per_second": last.evaluations_per_second,
        "failures": sum(result.failures.values()),
        "failures_by_kind": result.failures,
        "seed": seed,
        "generator": generator.name,
        "generator_version": generator.version,
        "image": tree.name,
        "colours": asdict(tree.colours),
        "mask": {"method": tree.extraction.method, "confidence": tree.extraction.confidence, "warnings": tree.warnings},
        "versions": {name: version(name) for name in PACKAGES},
        "candidates": [_candidate(found, tree) for found, tree in zip(result.candidates, files, strict=True)],
    }


def _candidate(found: Candidate, files: TreeFiles) -> dict[str, object]:
    return {
        **record(found, files.counts),
        **level_facts(files),
        "multipliers": dict(found.score.multipliers),
        "seed": found.seed,
        "seeds": found.seeds,
        "values": dict(found.values),
    }
