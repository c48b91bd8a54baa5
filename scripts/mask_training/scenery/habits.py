"""Habits: outlines of crowns and the ranges of their proportions, after kinds of trees in parks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scripts.mask_training.scenery.arrays import Floats

Range = tuple[float, float]


@dataclass(frozen=True)
class Habit:
    """A crown: half width at heights 0 to 1 of it as a share of the widest; ranges in heights of the tree."""

    outline: Callable[[Floats], Floats]
    bare: Range  # height of the lowest leaves
    half_width: Range
    clumps: tuple[int, int]  # count of clumps of leaves
    clump: Range  # radius of a clump as a share of the crown's half width
    stretch: Range  # of a clump: higher than wide
    leaders: tuple[int, int]  # stems that the trunk parts into
    girth: Range  # radius of the trunk at the foot
    share: float  # how often it is drawn


def _ball(t: Floats) -> Floats:
    return np.sqrt(np.maximum(0, 1 - (2 * t - 1) ** 2))


HABITS: dict[str, Habit] = {
    "round": Habit(_ball, (0.1, 0.33), (0.3, 0.56), (45, 110), (0.16, 0.3), (0.6, 0.9), (1, 4), (0.012, 0.035), 5.0),
    "oval": Habit(
        lambda t: _ball(t**0.9), (0.08, 0.3), (0.22, 0.38), (40, 90), (0.18, 0.32), (0.7, 1.1),
        (1, 2), (0.010, 0.025), 3.0,
    ),
    "spreading": Habit(
        lambda t: np.sqrt(np.maximum(0, 1 - t**2.2)) * np.minimum(1, 4 * t + 0.45), (0.14, 0.4), (0.42, 0.72),
        (40, 110), (0.12, 0.24), (0.5, 0.8), (2, 6), (0.02, 0.05), 3.0,
    ),
    "vase": Habit(
        lambda t: (0.25 + 0.75 * t) * np.sqrt(np.maximum(0, 1 - t**5)), (0.15, 0.36), (0.32, 0.55), (45, 110),
        (0.15, 0.3), (0.6, 1.0), (2, 6), (0.012, 0.03), 1.5,
    ),
    "egg": Habit(
        lambda t: _ball(t**0.6), (0.06, 0.28), (0.26, 0.46), (45, 110), (0.16, 0.3), (0.6, 1.0),
        (1, 2), (0.010, 0.025), 3.0,
    ),
    "irregular": Habit(
        _ball, (0.12, 0.42), (0.28, 0.55), (22, 50), (0.16, 0.32), (0.5, 1.0), (1, 5), (0.015, 0.04), 2.0,
    ),
    "column": Habit(
        lambda t: np.maximum(0, 1 - np.abs(2 * t - 1) ** 4) ** 0.3, (0.02, 0.14), (0.09, 0.18), (40, 90),
        (0.35, 0.6), (1.2, 2.5), (1, 2), (0.010, 0.02), 1.2,
    ),
    "pyramid": Habit(
        lambda t: np.maximum(0, 1 - t) ** 0.8 * np.minimum(1, 8 * t + 0.4), (0.03, 0.25), (0.2, 0.38), (50, 120),
        (0.13, 0.25), (0.6, 1.2), (1, 1), (0.010, 0.022), 2.0,
    ),
    "shrub": Habit(
        lambda t: np.sqrt(np.maximum(0, 1 - t**2)) * np.minimum(1, 3 * t + 0.6), (0.0, 0.06), (0.35, 0.7), (30, 90),
        (0.15, 0.3), (0.6, 1.0), (3, 7), (0.006, 0.015), 1.2,
    ),
    "high": Habit(_ball, (0.42, 0.64), (0.2, 0.4), (25, 70), (0.2, 0.38), (0.5, 0.9), (1, 3), (0.012, 0.055), 1.5),
    "umbrella": Habit(
        lambda t: np.sqrt(np.maximum(0, 1 - t**2)) * np.minimum(1, 5 * t + 0.3), (0.5, 0.72), (0.4, 0.65), (25, 60),
        (0.14, 0.26), (0.35, 0.6), (2, 6), (0.012, 0.03), 0.7,
    ),
}  # fmt: skip
"""Kinds of broad crowns by name."""


def drawn_habit(rng: np.random.Generator) -> Habit:
    """One of the habits by their shares."""
    habits = list(HABITS.values())
    share = np.array([habit.share for habit in habits])
    return habits[int(rng.choice(len(habits), p=share / share.sum()))]
