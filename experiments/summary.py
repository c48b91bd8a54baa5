"""Summary of a run: summary.json, read by other programs."""

from __future__ import annotations

from importlib.metadata import version

from experiments.candidate_facts import record
from experiments.read_tree import ReadTree
from treefit.asset import MeshCounts
from treefit.candidates import Candidate
from treefit.fit import Result
from treefit.plant import Generator

PACKAGES = ("treefit", "numpy", "numba")
"""Packages whose version may change a result."""


def summary(
    result: Result, generator: Generator, tree: ReadTree, seed: int, meshes: list[MeshCounts]
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
        "mask": {"method": tree.extraction.method, "confidence": tree.extraction.confidence, "warnings": tree.warnings},
        "versions": {name: version(name) for name in PACKAGES},
        "candidates": [_candidate(found, mesh) for found, mesh in zip(result.candidates, meshes, strict=True)],
    }


def _candidate(found: Candidate, mesh: MeshCounts) -> dict[str, object]:
    return {
        **record(found, mesh),
        "multipliers": dict(found.score.multipliers),
        "seed": found.seed,
        "seeds": found.seeds,
        "values": dict(found.values),
    }
