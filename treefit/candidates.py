"""Candidates: the few distinct trees that a search ends with, and how good each is beyond its own seed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from treefit.mask import Mask
from treefit.objective import Objective, Score
from treefit.plant import Genome, Plant, Value
from treefit.plant.extent import Extent, extent_of
from treefit.similarity.measures import class_iou, silhouette_iou
from treefit.view.frame import sample

REPORT_HEIGHT = 256  # rows at which masks are compared in reports


@dataclass(frozen=True, eq=False)
class Candidate:
    """One tree: its genome (n,), values by name, seed, scores, and the plant with its mask at 256 rows."""

    genome: Genome
    values: Mapping[str, Value]
    seed: int
    score: Score
    score_other_seeds: float | None
    silhouette_iou: float
    class_iou: float
    plant: Plant
    extent: Extent
    mask: Mask


def choose(objective: Objective, genomes: Sequence[Genome], count: int, min_distance: float) -> list[Genome]:
    """At most `count` of `genomes` (best first) that look different: 1 - ImSim of each other is `min_distance`.

    When too few are, the distance is halved until there are enough.
    """
    descriptions = []
    for genome in genomes:
        plant = objective.grow(genome, objective.seed)
        descriptions.append(objective.similarity.describe(objective.view(plant, objective.frame)))
    chosen: list[int] = []
    while len(chosen) < min(count, len(genomes)):
        for i in range(len(genomes)):
            likes = (objective.similarity.compare(descriptions[j], descriptions[i]) for j in chosen)
            if len(chosen) < count and i not in chosen and all(1.0 - like >= min_distance for like in likes):
                chosen.append(i)
        min_distance = min_distance / 2 if min_distance > 1e-3 else 0.0
    return [genomes[i] for i in sorted(chosen)]


def judge(objective: Objective, genome: Genome, target: Mask, other_seeds: int) -> Candidate:
    """Candidate of `genome`, compared with the mask `target` (h, w) and on `other_seeds` further seeds."""
    plant = objective.grow(genome, objective.seed)
    frame = objective.frame.finer(REPORT_HEIGHT)
    wanted, mask = sample(target, frame), objective.view(plant, frame).unpack()
    return Candidate(
        genome, objective.space.decode(genome), objective.seed, objective.score(plant),
        _on_other_seeds(objective, genome, other_seeds), silhouette_iou(wanted, mask), class_iou(wanted, mask), plant,
        extent_of(plant), mask,
    )  # fmt: skip


def _on_other_seeds(objective: Objective, genome: Genome, count: int) -> float | None:
    if count == 0:
        return None
    seeds = range(objective.seed + 1, objective.seed + 1 + count)
    return float(np.mean([objective.on(seed)(genome).total for seed in seeds]))
