"""Scale: rules on the parameters that a generator declares to be its size and its age."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from treefit.plant.contract.faults import ContractError, NotTried, Shortcoming
from treefit.plant.contract.sample import Sample, grow
from treefit.plant.generator import Budget
from treefit.plant.parameters import Parameter, Value
from treefit.plant.plant import Plant

NEAR = 1e-4
"""How far numbers may be from each other, as share of them, or of the tenth part of the whole extent."""

UNDECLARED = "it declares none"
SHARES = 0.25, 0.5, 1.0
"""Ages, as shares of the usual one, at which a plant is grown."""


def the_size_parameter_scales_and_does_nothing_else(sample: Sample) -> str:
    """Positions and radii are as many times as large as the size; lengths of leaves too, or not at all."""
    name = sample.generator.size_parameter
    if name is None:
        return UNDECLARED
    parameter = _parameter(sample, name)
    large = parameter.high
    small = max(large / 2, parameter.low)
    if parameter.kind == "int":
        large, small = int(large), int(small)
    elif parameter.kind != "float":
        raise ContractError(f"{name} is a {parameter.kind}: a size is a number")
    typical, _ = sample.typical
    attempts = [grow(sample.generator, {**typical.values, name: size}, typical.seed, _broad(sample))
                for size in (small, large)]  # fmt: skip
    for size, attempt in zip((small, large), attempts, strict=True):
        if attempt.plant is None or attempt.plant.cut:
            words = attempt.failure or "it is cut"
            raise ContractError(f"no plant at {name} = {size:g}: {words}", attempt.values, attempt.seed)
    one, two = (attempt.plant for attempt in attempts)
    assert one is not None
    assert two is not None
    if words := _unlike(one, two, large / small):
        cure = "every length follows the size, or size_parameter is not declared"
        raise ContractError(f"from {small:g} to {large:g} {words}; {cure}", attempts[1].values, typical.seed)
    return f"{name}, {small:g} and {large:g}"


def _broad(sample: Sample) -> Budget:
    """The usual budget, or that of the sample when that is broader."""
    usual = Budget()
    return Budget(max(usual.vertices, sample.budget.vertices), max(usual.leaves, sample.budget.leaves))


def _unlike(one: Plant, two: Plant, factor: float) -> str:
    """What is not `factor` times as large in plant `two`, "" when all is."""
    if (one.n_vertices, one.n_leaves) != (two.n_vertices, two.n_leaves):
        counts = (f"{plant.n_vertices} vertices and {plant.n_leaves} leaves" for plant in (one, two))
        return f"it has other parts: {' against '.join(counts)}"
    if not (np.array_equal(one.parent, two.parent) and np.array_equal(one.level, two.level)):
        return "its graph changes"
    extent = 0.1 * float(np.abs(two.position).max())
    for name, slack in (("position", extent), ("radius", 0.0), ("leaf_position", extent)):
        if not _close(factor * getattr(one, name), getattr(two, name), slack):
            return f"{name} does not become {factor:g} times as large"
    if not _close(one.leaf_axis, two.leaf_axis, 20.0):
        return "leaves turn"
    if not any(_close(times * one.leaf_size, two.leaf_size, 0.0) for times in (1.0, factor)):
        return f"leaf_size becomes neither {factor:g} times as large nor stays"
    return ""


def _close(one: NDArray[np.float32], two: NDArray[np.float32], slack: float) -> bool:
    return bool(np.allclose(one, two, rtol=NEAR, atol=NEAR * slack + 1e-12))


def the_age_parameter_counts_years(sample: Sample) -> str:
    """The age is a whole number from 1, and a plant does not become lower with the years."""
    name = sample.generator.age_parameter
    if name is None:
        return UNDECLARED
    parameter = _parameter(sample, name)
    if parameter.kind != "int" or parameter.low < 1:
        raise ContractError(f"{name} is a {parameter.kind} from {parameter.low:g}: years are an int from 1")
    typical, _ = sample.typical
    usual = max(int(typical.values[name]), int(parameter.low) + 2)
    ages = sorted({max(int(share * usual), int(parameter.low)) for share in SHARES})
    heights = dict[int, float]()
    for age in ages:
        values: dict[str, Value] = {**typical.values, name: age}
        attempt = grow(sample.generator, values, typical.seed, _broad(sample))
        if attempt.plant is None:
            raise ContractError(f"no plant at {name} = {age}: {attempt.failure}", values, typical.seed)
        heights[age] = float(attempt.plant.position[:, 2].max())
    told = ", ".join(f"{height:.3g} m at {age}" for age, height in heights.items())
    if any(old < young * (1 - NEAR) for young, old in pairwise(heights.values())):
        raise Shortcoming(f"the plant becomes lower: {told}", typical.values, typical.seed)
    if len(set(heights.values())) == 1:
        raise Shortcoming(f"the plant does not grow: {told}", typical.values, typical.seed)
    return told


def _parameter(sample: Sample, name: str) -> Parameter:
    for parameter in sample.generator.space.parameters:
        if parameter.name == name:
            return parameter
    raise NotTried(f"the space has no {name}")
