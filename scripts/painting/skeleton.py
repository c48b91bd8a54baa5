"""Skeleton of a broadleaf tree: branches grow towards free places of a crown until every place is reached.

Space colonisation after Runions, Lane and Prusinkiewicz, "Modeling Trees with a Space Colonization Algorithm" (2007).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

STEP = 0.022
REACHED = 1.6 * STEP
MOST_ROUNDS = 150
PIPE = 2.3
TWIG = 0.0016

Points = NDArray[np.float64]
"""(n, 3) x to the right, y up, z to the viewer, in tree heights; the foot is the origin."""


@dataclass(frozen=True)
class Limb:
    """One unforked way from its base to a tip: points (n, 3), radii (n,), both in tree heights."""

    points: Points
    radii: NDArray[np.float64]


def grow(places: Points, bare: float, girth: float, rng: np.random.Generator) -> list[Limb]:
    """Limbs that reach all `places`, the trunk first, `bare` high below its first branch and `girth` in radius."""
    points, parents = _colonise(places, bare, rng)
    radii = _radii(parents, girth)
    children: dict[int, list[int]] = {}
    for index, parent in enumerate(parents):
        children.setdefault(parent, []).append(index)
    limbs, starts = [], [[0]]
    while starts:
        way = starts.pop(0)
        while way[-1] in children:
            thickest, *others = sorted(children[way[-1]], key=lambda child: -radii[child])
            starts += [[way[-1], other] for other in others]
            way.append(thickest)
        limbs.append(_limb(points[way], radii[way], is_trunk=way[0] == 0))
    return limbs


def _colonise(places: Points, bare: float, rng: np.random.Generator) -> tuple[Points, list[int]]:
    rise = np.arange(0, bare + STEP, STEP)
    sway = 0.008 * np.sin(rise * 9 + rng.uniform(0, 6))
    points = list(np.stack((sway - sway[0], rise, np.zeros_like(rise)), axis=1))
    parents = list(range(-1, len(points) - 1))
    free = places
    for _ in range(MOST_ROUNDS):
        distance, nearest = cKDTree(np.array(points)).query(free)
        free, nearest = free[distance > REACHED], nearest[distance > REACHED]
        if len(free) == 0:
            break
        for node in np.unique(nearest):
            pull = free[nearest == node] - points[node]
            way = (
                (pull / np.linalg.norm(pull, axis=1, keepdims=True)).mean(axis=0)
                + rng.normal(0, 0.12, 3)
                + (0, 0.10, 0)
            )
            points.append(points[node] + STEP * way / np.linalg.norm(way))
            parents.append(int(node))
    return np.array(points), parents


def _radii(parents: list[int], girth: float) -> NDArray[np.float64]:
    """Pipe model: what a branch carries is the sum of what its children carry."""
    carried = np.full(len(parents), TWIG**PIPE)
    for index in range(len(parents) - 1, 0, -1):
        carried[parents[index]] += carried[index]
    radii = carried ** (1 / PIPE)
    return np.asarray(np.maximum(TWIG, radii * girth / radii[0]))


def _limb(points: Points, radii: NDArray[np.float64], is_trunk: bool) -> Limb:
    radii = radii.copy()
    if is_trunk:
        # the foot widens into its roots
        radii *= 1 + 0.85 * np.exp(-points[:, 1] * 30)
    else:
        # a branch is no thicker at its fork than just above it
        radii[0] = radii[1]
    return Limb(points, radii)
