"""Time of plants that are given by their values: to grow, and for the whole way of an evaluation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from experiments.timing import in_turn
from treefit.objective import Objective
from treefit.plant import Values, check_plant


def plant_speed(objective: Objective, wanted: Sequence[Values]) -> dict[str, object]:
    """Mean vertices and leaves of the plants, and ns of processor time by vertex and leaf.

    An evaluation decodes a genome, grows and checks a plant, and sees, compares and scores it. Values of a preset need
    not be those of any genome, so what is decoded is another one.
    """
    generator, seed, budget = objective.generator, objective.seed, objective.budget
    genome = np.full(len(objective.space), 0.5)

    def evaluate(values: Values) -> None:
        objective.space.decode(genome)
        plant = generator(values, seed, budget)
        check_plant(plant)
        objective.score(plant)

    plants = [generator(values, seed, budget) for values in wanted]
    vertices, leaves = (float(np.mean([getattr(p, name) for p in plants])) for name in ("n_vertices", "n_leaves"))
    taken = in_turn({"grow": lambda values: generator(values, seed, budget), "evaluate": evaluate}, wanted)
    by_primitive = {f"{name}_ns_per_primitive": 1e6 * ms / (vertices + leaves) for name, ms in taken.items()}
    return {"vertices": round(vertices), "leaves": round(leaves), **by_primitive}
