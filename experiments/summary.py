"""Summary of a run: summary.json, read by other programs, and the rows of the table at its end."""

from __future__ import annotations

from importlib.metadata import version

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
        "score": found.score.total,
        "image_similarity": found.score.image,
        "multipliers": dict(found.score.multipliers),
        "score_other_seeds": found.score_other_seeds,
        "silhouette_iou": found.silhouette_iou,
        "class_iou": found.class_iou,
        "vertices": found.plant.n_vertices,
        "leaves": found.plant.n_leaves,
        "triangles": mesh.triangles,
        "height_m": found.extent.height,
        "width_m": found.extent.width,
        "seed": found.seed,
        "values": dict(found.values),
    }


def rows(result: Result, meshes: list[MeshCounts]) -> list[dict[str, float | int | str]]:
    """Rows of the table shown in the terminal, a candidate each."""
    return [
        {
            "candidate": i + 1, "score": found.score.total,
            "other seeds": "-" if found.score_other_seeds is None else found.score_other_seeds,
            "silhouette IoU": found.silhouette_iou, "class IoU": found.class_iou, "vertices": found.plant.n_vertices,
            "leaves": found.plant.n_leaves, "triangles": mesh.triangles, "height": f"{found.extent.height:.1f} m",
        }
        for i, (found, mesh) in enumerate(zip(result.candidates, meshes, strict=True))
    ]  # fmt: skip
