"""Trees of WeberPennGen without variation, whose stems can be measured one by one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from generators.weberpenn import WeberPennGen
from scripts.census import begins
from treefit.plant import Budget, Plant, Value

GENERATOR = WeberPennGen(full=True)
BROAD = Budget(100_000, 200_000)
STRAIGHT: dict[str, Value] = {
    "levels": 2, "shape": 3, "scale": 10, "base_size": 0.2, "flare": 0, "leaves": 0, "leaf_bend": 0, "attraction_up": 0,
    "branches_1": 10, "down_angle_1": 90, **{f"curve_v_{n}": 0 for n in range(4)},
}  # fmt: skip
CROWNED: dict[str, Value] = {
    **STRAIGHT, "levels": 3, "scale": 12, "branches_1": 40, "branches_2": 10, "curve_v_1": 60, "curve_v_2": 60,
}  # fmt: skip


def grow(base: dict[str, Value], seed: int = 1, **values: Value) -> Plant:
    plant = GENERATOR(GENERATOR.space.complete({**base, **values}), seed, BROAD)
    assert not plant.cut
    return plant


def stems(plant: Plant, level: int) -> list[NDArray[np.float32]]:
    """Places (n, 3) of the vertices of each stem of a level, which has no clones, in the order of their bases."""
    found = []
    for base in np.flatnonzero(begins(plant) & (plant.level == level)):
        path = [base]
        while (after := np.flatnonzero((plant.parent == path[-1]) & (plant.level == level))).size:
            path.append(after[0])
        found.append(plant.position[path])
    return found


def directions(path: NDArray[np.float32]) -> NDArray[np.float32]:
    steps = np.diff(path, axis=0)
    return steps / np.linalg.norm(steps, axis=1, keepdims=True)


def length(path: NDArray[np.float32]) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def wood(plant: Plant, levels: int = 4) -> bytes:
    lower = plant.level < levels
    return plant.position[lower].tobytes() + plant.radius[lower].tobytes() + plant.parent[lower].tobytes()
