"""Purity: rules on the same input, which gives the same plant, whatever else goes on."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from treefit.plant.contract.faults import ContractError, Shortcoming, reason
from treefit.plant.contract.same import difference, digest, same
from treefit.plant.contract.sample import Sample, narrower
from treefit.plant.generator import Budget

AT_ONCE = 3
"""Threads that grow plants at the same time."""

OTHERS = 2
"""Plants of a broad budget that are grown between two plants that must be the same."""


def the_same_input_gives_the_same_bytes(sample: Sample) -> str:
    """A plant that is grown again, after others and in another order, has the same bytes."""
    for one in (replace(sample, attempts=[attempt for attempt, _ in sample.grown[: sample.few]]),
                narrower(sample, sample.few)):  # fmt: skip
        for attempt, _ in one.grown[:OTHERS]:
            one.again(attempt, Budget())
        for attempt, plant in reversed(one.grown):
            if words := difference(plant, one.again(attempt)):
                cure = "draw from streams keyed by the seed, and keep nothing from tree to tree"
                raise ContractError(f"the second time it gives {words}; {cure}", attempt.values, attempt.seed)
    return ""


def several_at_once_give_the_same_bytes(sample: Sample) -> str:
    """Plants that grow in threads at once, or in a copy for another process, have the same bytes as one by one."""
    if sample.generator.parallel != "threads":
        return _by_a_copy(sample)
    with ThreadPoolExecutor(AT_ONCE) as pool:
        for one in (sample, narrower(sample, sample.few)):
            few = one.grown[: sample.few]
            for (attempt, plant), found in zip(few, pool.map(one.again, [attempt for attempt, _ in few]), strict=True):
                if words := difference(plant, found):
                    cure = 'keep what is written apart for each thread, or say parallel = "processes"'
                    raise ContractError(f"in threads it gives {words}; {cure}", attempt.values, attempt.seed)
    return f"{AT_ONCE} threads"


def _by_a_copy(sample: Sample) -> str:
    try:
        copy = replace(sample, generator=pickle.loads(pickle.dumps(sample.generator)))
    except Exception as error:
        cure = "processes need a copy of the generator"
        raise ContractError(f"it cannot be pickled: {reason(error)}; {cure}") from error
    for attempt, plant in sample.grown[: sample.few]:
        if words := difference(plant, copy.again(attempt)):
            raise ContractError(f"a copy of the generator gives {words}", attempt.values, attempt.seed)
    return "a copy for another process"


def plants_stay_as_they_are(sample: Sample) -> str:
    """No array of a plant changes when further plants are grown."""
    for attempt, plant in sample.grown:  # the first `few` are the generator's own, not copies
        if digest(plant) != attempt.digest:
            cure = "give back copies of arrays that are used again"
            raise ContractError(f"a plant changed when others were grown; {cure}", attempt.values, attempt.seed)
    return ""


def values_are_left_alone(sample: Sample) -> str:
    """The values that a generator is given are the caller's, and not changed."""
    for attempt in sample.attempts:
        if attempt.touched:
            raise ContractError("it changes the values that it is given; take a copy", attempt.values, attempt.seed)
    return ""


def another_seed_gives_another_plant(sample: Sample) -> str:
    """Two seeds give two plants; without that the further seeds of a score tell nothing."""
    first, plant = sample.typical
    others = [(first, plant), *sample.grown[: sample.few]]
    pairs = [(one, found) for attempt, one in others if (found := sample.other(attempt.seed + 1, attempt.values))]
    alike = sum(same(one, two) for one, two in pairs)
    if alike == len(pairs):
        raise Shortcoming("all seeds give the same plant: chance has no part in it", first.values, first.seed)
    if same(*pairs[0]) or alike > len(pairs) / 2:
        told = f"on {alike} of {len(pairs)} plants the seed has no effect"
        raise Shortcoming(told, first.values, first.seed)
    return f"{len(pairs) - alike} of {len(pairs)}" if alike else ""
