"""Shape: rules on what plants of random genomes look like."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from treefit.plant.contract.faults import ContractError, Shortcoming
from treefit.plant.contract.sample import Sample
from treefit.plant.plant import Plant

MOST_FAILURES = 0.1
"""Share of random genomes without a plant, over which a search wastes too much."""

NEAR = 2e-3
"""How far lengths of directions may be from 1, and the products of two from 0: fast roots of kernels are no nearer."""


def random_genomes_give_valid_plants(sample: Sample) -> str:
    """At least nine of ten random genomes give a valid plant, and all of them should."""
    tried = len(sample.attempts)
    failed = [attempt for attempt in sample.attempts if attempt.plant is None]
    if not failed:
        return f"{tried} of {tried}"
    first = failed[0]
    share = f"{len(failed)} of {tried} give none, the first: {first.failure}"
    if len(failed) > MOST_FAILURES * tried:
        cure = f"{MOST_FAILURES:.0%} may fail at most: make ranges narrower"
        raise ContractError(f"{share}; {cure}", first.values, first.seed)
    raise Shortcoming(share, first.values, first.seed)


def the_defaults_give_a_plant(sample: Sample) -> str:
    """The defaults of all parameters together give a plant."""
    if sample.default.plant is None:
        raise Shortcoming(f"they give none: {sample.default.failure}", sample.default.values, sample.default.seed)
    return f"{sample.default.plant.n_vertices:,} vertices, {sample.default.plant.n_leaves:,} leaves"


def the_root_stands_at_the_origin(sample: Sample) -> str:
    """Vertex 0 of a plant is at 0, 0, 0, exactly."""
    return _all(sample, _away, ContractError, "move the tree there")


def nothing_grows_below_the_ground(sample: Sample) -> str:
    """No vertex of a plant is lower than its root: pictures end at the foot of the trunk."""
    return _all(sample, _buried, Shortcoming, "pictures end at the foot of the trunk")


def plants_rise_over_the_ground(sample: Sample) -> str:
    """Every plant that is whole has a height, for masks are compared in heights."""
    return _all(sample, _flat, Shortcoming, "masks are compared in heights")


def leaves_have_unit_axes_and_normals_at_right_angles(sample: Sample) -> str:
    """Axis and normal of a leaf have length 1 and are at right angles, its length and width are not negative."""
    return _all(sample, _crooked, ContractError, "make both unit, and the normal square to the axis")


def levels_rise_by_one_at_most(sample: Sample) -> str:
    """The trunk has level 0, and along the graph a level stays or rises by one."""
    return _all(sample, _skipping, ContractError, "a branch has the level of its parent plus one")


def _all(sample: Sample, fault: Callable[[Plant], str], kind: type[ContractError], cure: str) -> str:
    """Raise a fault of the `kind` when a plant has one, with the first of them and their count."""
    faults = [(attempt, words) for attempt, plant in sample.grown if (words := fault(plant))]
    if faults:
        attempt, words = faults[0]
        count = f"{len(faults)} of {len(sample.grown)} plants"
        raise kind(f"{count}: {words}; {cure}", attempt.values, attempt.seed)
    return ""


def _away(plant: Plant) -> str:
    x, y, z = plant.position[0]
    return "" if x == y == z == 0 else f"the root is at {x:.4g}, {y:.4g}, {z:.4g}"


def _buried(plant: Plant) -> str:
    lowest = float(plant.position[:, 2].min())
    return "" if lowest >= 0 else f"a vertex is at z = {lowest:.4g} m"


def _flat(plant: Plant) -> str:
    highest = float(plant.position[:, 2].max())
    return "" if plant.cut or highest > 0 else f"the highest vertex is at z = {highest:.4g} m"


def _crooked(plant: Plant) -> str:
    axis, normal = plant.leaf_axis, plant.leaf_normal
    for name, rows in (("leaf_axis", axis), ("leaf_normal", normal)):
        length = np.linalg.norm(rows, axis=1)
        if (far := _farthest(length - 1)) > NEAR:
            return f"{name} has a length of {length[np.argmax(np.abs(length - 1))]:.4g}, {far:.2g} from 1"
    if (far := _farthest((axis * normal).sum(axis=1))) > NEAR:
        return f"leaf_axis and leaf_normal are not at right angles, their product is {far:.2g}"
    return "" if (plant.leaf_size >= 0).all() else f"leaf_size has {plant.leaf_size.min():.4g}"


def _farthest(rows: NDArray[np.float32]) -> float:
    return float(np.abs(rows).max(initial=0.0))


def _skipping(plant: Plant) -> str:
    if plant.level[0] != 0:
        return f"the root has level {plant.level[0]}"
    rise = plant.level[1:] - plant.level[plant.parent[1:]]
    wrong = np.flatnonzero((rise < 0) | (rise > 1))
    if not len(wrong):
        return ""
    vertex = int(wrong[0]) + 1
    return f"vertex {vertex} has level {plant.level[vertex]}, its parent {plant.level[plant.parent[vertex]]}"
