"""Limits: rules on the budget of vertices and leaves, and on how large and slow plants are."""

from __future__ import annotations

import numpy as np

from treefit.plant.contract.faults import ContractError, Shortcoming
from treefit.plant.contract.same import difference
from treefit.plant.contract.sample import Attempt, Sample
from treefit.plant.generator import Budget
from treefit.plant.plant import Plant

BUDGETS = Budget(2, 0), Budget(50, 10), Budget(500, 100)
EXACT = 4
"""Vertices and leaves of four budgets are those of a plant, or one under."""

MOST_CUT = 0.5
"""Share of random plants, cut by the budget, over which a search wastes too much."""

SLOW = 1.0
"""Seconds a plant over which 50,000 of them take most of a day on one core."""

FIT = 50_000
"""Plants that a fit grows by default."""

APART = 1000.0
"""How many times as high as the lowest the highest plant may be, when the size has no parameter of its own."""


def the_budget_is_never_passed_and_a_cut_is_told(sample: Sample) -> str:
    """A plant has at most the vertices and leaves of its budget, and says so when it would have had more."""
    most = sample.budget
    for limits in BUDGETS:
        budget = Budget(min(limits.vertices, most.vertices), min(limits.leaves, most.leaves))
        for attempt, whole in sample.grown[: sample.few]:
            if words := _wrong(whole, sample.again(attempt, budget), budget):
                raise ContractError(f"{words} ({_told(budget)})", attempt.values, attempt.seed)
    return ""


def nothing_is_cut_that_has_room(sample: Sample) -> str:
    """A budget of exactly a plant's own vertices and leaves gives all of it, and one less of either cuts it."""
    tried = 0
    for attempt, whole in sample.grown[: sample.few]:
        v, k = whole.n_vertices, whole.n_leaves
        if whole.cut or v < 3:
            continue
        for budget in (Budget(v, k), Budget(v - 1, k), *([Budget(v, k - 1)] if k else [])):
            if words := _wrong(whole, sample.again(attempt, budget), budget):
                raise Shortcoming(f"{words} ({_told(budget)}, exactly)", attempt.values, attempt.seed)
        tried += 1
    return f"on {tried} plants" if tried else "no plant is whole"


def most_plants_fit_the_budget(sample: Sample) -> str:
    """At most half of the random plants are cut, for those score 0."""
    plants = [plant for _, plant in sample.grown]
    vertices, leaves = ([getattr(plant, name) for plant in plants] for name in ("n_vertices", "n_leaves"))
    cut = [attempt for attempt, plant in sample.grown if plant.cut]
    found = f"{np.median(vertices):,.0f} vertices, {np.percentile(vertices, 95):,.0f} at the 95th of 100, "
    found += f"{np.median(leaves):,.0f} leaves; {len(cut)} of {len(plants)} plants are cut"
    if len(cut) > MOST_CUT * len(plants):
        cure = "narrow the ranges of what counts branches and leaves: cut plants score 0"
        raise Shortcoming(f"{found} ({_told(sample.budget)}); {cure}", cut[0].values, cut[0].seed)
    return found


def a_plant_takes_no_more_than_a_second(sample: Sample) -> str:
    """All but one in twenty plants take a second at most."""
    attempts = [attempt for attempt, _ in sample.grown]
    seconds = [attempt.seconds for attempt in attempts]
    median, late, longest = np.median(seconds), np.percentile(seconds, 95), max(seconds)
    found = f"{1e3 * median:.3g} ms, {1e3 * late:.3g} at the 95th of 100, {1e3 * longest:.3g} the longest; "
    found += f"{FIT:,} take {_time(FIT * float(np.mean(seconds)))} on one core"
    if late > SLOW:
        slowest = max(attempts, key=_seconds)
        raise Shortcoming(found, slowest.values, slowest.seed)
    return found


def heights_are_of_one_kind(sample: Sample) -> str:
    """No random plant that is whole is a thousand times as high as another."""
    heights = {float(plant.position[:, 2].max()): attempt for attempt, plant in sample.grown if not plant.cut}
    if not heights:
        return "no plant is whole"
    low, high = min(heights), max(heights)
    if high > APART * max(low, 0.0):
        attempt = heights[low]
        raise Shortcoming(f"from {low:.3g} to {high:.3g} m: are units mixed up?", attempt.values, attempt.seed)
    return f"{low:.3g} to {high:.3g} m"


def _wrong(whole: Plant, plant: Plant, budget: Budget) -> str:
    """What is wrong with a `plant` that was grown within `budget`, "" when nothing is."""
    if plant.n_vertices > budget.vertices or plant.n_leaves > budget.leaves:
        return f"has {plant.n_vertices} vertices and {plant.n_leaves} leaves: stop growing there"
    fits = not whole.cut and whole.n_vertices <= budget.vertices and whole.n_leaves <= budget.leaves
    if plant.cut and fits:
        return f"is cut, though it has only {whole.n_vertices} vertices and {whole.n_leaves} leaves"
    if not plant.cut and not fits:
        told = f"{whole.n_vertices} vertices and {whole.n_leaves} leaves were there before"
        return f"does not say that it was cut ({told}): set Plant.cut"
    if fits and (words := difference(whole, plant)):
        return f"fits the budget, which changes it all the same: {words}"
    return ""


def _told(budget: Budget) -> str:
    return f"budget {budget.vertices:,} vertices, {budget.leaves:,} leaves"


def _seconds(attempt: Attempt) -> float:
    return attempt.seconds


def _time(seconds: float) -> str:
    if seconds < 120:
        return f"{seconds:.2g} s" if seconds < 10 else f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
