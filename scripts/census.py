"""Census: what a plant counts and measures by level: stems, clones, lengths, radii, vertices, leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.plant import Plant

Numbers = NDArray[np.float64]  # (levels,)


@dataclass(frozen=True)
class Census:
    """Counts and means of one plant; arrays have a number a level."""

    stems: Numbers
    clones: Numbers  # forks of stems, which are no stems of their own
    length: Numbers  # mean of the stems, m, along the stem and not along its clones
    radius: Numbers  # mean of the stems at their base, m; that of the trunk without its flare
    height: float  # m, of the highest vertex
    vertices: int
    leaves: int


def begins(plant: Plant) -> NDArray[np.bool_]:
    """Whether a stem begins at each vertex (v,)."""
    return np.concatenate([[True], plant.level[1:] > plant.level[plant.parent[1:]]])


def forks(plant: Plant) -> NDArray[np.bool_]:
    """Whether a clone begins at each vertex (v,): it goes on from one that another vertex of the level goes on from."""
    going_on = np.flatnonzero(~begins(plant))
    _, first = np.unique(plant.parent[going_on], return_index=True)
    fork = np.zeros(plant.n_vertices, bool)
    fork[np.delete(going_on, first)] = True
    return fork


def census(plant: Plant, flare: float) -> Census:
    """Count and measure `plant`, whose trunk's foot is wider by 0.99 `flare`."""
    base, fork = begins(plant), forks(plant)
    step = np.zeros(plant.n_vertices)
    step[1:] = np.linalg.norm(plant.position[1:] - plant.position[plant.parent[1:]], axis=1)
    step[base] = 0.0
    step[_beside(plant, base, fork)] = 0.0
    levels = int(plant.level.max()) + 1
    radius = plant.radius[base].astype(np.float64)
    radius[0] /= 1 + 0.99 * flare
    stems = np.bincount(plant.level[base], minlength=levels)
    return Census(
        stems.astype(np.float64), np.bincount(plant.level[fork], minlength=levels).astype(np.float64),
        np.bincount(plant.level, step, levels) / stems, np.bincount(plant.level[base], radius, levels) / stems,
        float(plant.position[:, 2].max()), plant.n_vertices, plant.n_leaves,
    )  # fmt: skip


def _beside(plant: Plant, base: NDArray[np.bool_], fork: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether each vertex is on a clone: the mark goes on from parent to child until no vertex is left to reach."""
    beside, reached = fork, -1
    while beside.sum() > reached:
        reached = int(beside.sum())
        beside = beside | (beside[plant.parent] & ~base)
    return beside
