"""Changes: what is wrong with the plants of sticks that break the contract."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from tests.plant.contract.sticks import Change, Sticks, grow
from treefit.plant import Budget, Plant


def bent(plant: Plant, **rows: np.ndarray) -> Plant:
    return replace(plant, **{name: array.astype(getattr(plant, name).dtype) for name, array in rows.items()})


def plants(change: Callable[[Plant], Plant], **settings: object) -> Sticks:
    """Sticks whose every plant is changed."""
    return Sticks(lambda plant, values, seed, budget: change(plant), **settings)


def lifted(plant: Plant, shift: tuple[float, float, float]) -> Plant:
    """All of a plant in another place, by its trunk's height."""
    far = np.array(shift) * plant.position[:, 2].max()
    return bent(plant, position=plant.position + far, leaf_position=plant.leaf_position + far)


def sunken(plant: Plant) -> Plant:
    position = plant.position.copy()
    position[-1, 2] = -0.1 * position[:, 2].max()
    return replace(plant, position=position)


def picky(share: float) -> Change:
    """No plant where the spread is in the lowest `share` of its range."""

    def change(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
        if float(values["spread"]) < 0.1 + 0.4 * share:
            raise RuntimeError("too\nnarrow")
        return plant

    return change


def no_defaults(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    if values["spread"] == 0.3:
        raise RuntimeError("not these")
    return plant


def meddling(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    values["height"] = 0.0
    return plant


def remembering() -> Change:
    """The plant after one of the broadest budget has traces of it."""
    seen: list[Budget] = []

    def change(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
        before = seen[-1] if seen else budget
        seen[:] = [budget]
        return bent(plant, radius=plant.radius * 2) if before == Budget() != budget else plant

    return change


def in_main_thread(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    main = threading.current_thread() is threading.main_thread()
    return plant if main else bent(plant, radius=plant.radius * 2)


def one_memory() -> Change:
    """All plants have their radii in the same place."""
    memory = np.zeros(10_000, np.float32)

    def change(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
        memory[: plant.n_vertices] = plant.radius
        return replace(plant, radius=memory[: plant.n_vertices])

    return change


def three_at_least(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    return grow(values, seed, Budget(3, budget.leaves)) if budget.vertices < 3 else plant


def silent(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    """A plant that does not say that it was cut when no leaf may grow."""
    return replace(plant, cut=False) if budget.leaves == 0 else plant


def cautious(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    full = budget.vertices <= plant.n_vertices
    return replace(plant, cut=plant.cut or full)


def shrinking(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    return bent(plant, position=plant.position / float(values["years"]) ** 2)


def mixed_units(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    large = 1e4 if values["twigs"] == 1 else 1.0
    return bent(plant, position=plant.position * large)


def seeded(plant: Plant, values: dict[str, object], seed: int, budget: Budget) -> Plant:
    return grow(values, seed + int(values["trunk.seed"]), budget)
