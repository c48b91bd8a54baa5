"""Broken: for each rule of the contract generators that break it and no other."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from tests.plant.contract.changes import (
    bent,
    cautious,
    in_main_thread,
    lifted,
    meddling,
    mixed_units,
    no_defaults,
    one_memory,
    picky,
    plants,
    remembering,
    seeded,
    shrinking,
    silent,
    sunken,
    three_at_least,
)
from tests.plant.contract.sticks import SPACE, Sticks, grow
from treefit.plant import Budget, Genome, Parameter, ParameterSpace, Preset, Values


@dataclass(frozen=True)
class Broken:
    """A generator, the rule that it breaks, the verdict, and words that the message must have."""

    rule: str
    words: str
    generator: Sticks
    verdict: str = "failed"
    budget: Budget = field(default_factory=lambda: Budget(3_000, 3_000))


class Lossy(ParameterSpace):
    def encode(self, values: Values) -> Genome:
        return np.full(len(self), 0.5)


def space(*more: Parameter, **changed: Parameter) -> ParameterSpace:
    return ParameterSpace(tuple(changed.get(one.name, one) for one in SPACE.parameters) + more)


def preset(**changed: object) -> dict[str, Preset]:
    return {"oak": replace(Preset("sticks", "1", 3, {"height": 9.0}), **changed)}


UNAGED: dict[str, None] = {"age_parameter": None}
IDLE = Parameter("idle", 0.0, 1.0, default=0.5)
BROKEN = [
    Broken("it says what it is", "version must be a text, got ''", Sticks(version="")),
    Broken("it says what it is", "parallel must be one of threads, processes, got 'yes'", Sticks(parallel="yes")),
    Broken(
        "the space is sane",
        "trunk.seed is searched: fix it",
        Sticks(seeded, space(Parameter("trunk.seed", 0, 99, kind="int", default=5))),
    ),
    Broken(
        "the space is sane",
        "defaults out of their ranges: height",
        Sticks(space=space(height=Parameter("height", 2.0, 9.0, default=10.0))),
        "warning",
    ),
    Broken("the space is sane", "size_parameter 'width' is no parameter", Sticks(size_parameter="width")),
    Broken("the space is sane", "no gene: at least one", Sticks(space=SPACE.fix(**SPACE.complete({})))),
    Broken("values and genomes round trip", "comes back as", Sticks(space=Lossy(SPACE.parameters))),
    Broken(
        "random genomes give valid plants",
        "give none, the first: RuntimeError: too narrow; 10% may fail at most",
        Sticks(picky(0.3)),
    ),
    Broken(
        "random genomes give valid plants",
        "of 40 give none, the first: RuntimeError: too narrow; e.g. height=",
        Sticks(picky(0.15)),
        "warning",
    ),
    Broken("the defaults give a plant", "RuntimeError: not these", Sticks(no_defaults), "warning"),
    Broken(
        "the root stands at the origin",
        "40 of 40 plants: the root is at ",
        plants(lambda plant: lifted(plant, (1.0, 0, 0))),
    ),
    Broken("nothing grows below the ground", "40 of 40 plants: a vertex is at z = -", plants(sunken), "warning"),
    Broken(
        "plants rise over the ground",
        "highest vertex is at z = 0 m",
        plants(lambda plant: bent(plant, position=plant.position * [1, 1, 0]), **UNAGED),
        "warning",
    ),
    Broken(
        "leaves have unit axes and normals at right angles",
        "leaf_axis has a length of 1.5",
        plants(lambda plant: bent(plant, leaf_axis=plant.leaf_axis * 1.5)),
    ),
    Broken(
        "leaves have unit axes and normals at right angles",
        "are not at right angles",
        plants(lambda plant: bent(plant, leaf_normal=plant.leaf_axis)),
    ),
    Broken(
        "leaves have unit axes and normals at right angles",
        "leaf_size has -",
        plants(lambda plant: bent(plant, leaf_size=-plant.leaf_size)),
    ),
    Broken(
        "levels rise by one at most",
        "has level 2, its parent 0",
        plants(lambda plant: bent(plant, level=2 * plant.level)),
    ),
    Broken(
        "levels rise by one at most", "the root has level 1", plants(lambda plant: bent(plant, level=1 + plant.level))
    ),
    Broken("values are left alone", "take a copy", Sticks(meddling)),
    Broken(
        "the same input gives the same bytes",
        "the second time it gives other numbers in radius",
        Sticks(remembering(), size_parameter=None, **UNAGED),
    ),
    Broken(
        "several at once give the same bytes", "in threads it gives other numbers in radius", Sticks(in_main_thread)
    ),
    Broken(
        "several at once give the same bytes",
        "it cannot be pickled",
        Sticks(lambda plant, *_: plant, parallel="processes"),
    ),
    Broken("plants stay as they are", "give back copies", Sticks(one_memory(), size_parameter=None)),
    Broken(
        "another seed gives another plant",
        "all seeds give the same plant",
        Sticks(lambda plant, values, seed, budget: grow(values, 0, budget)),
        "warning",
    ),
    Broken(
        "the budget is never passed and a cut is told",
        "has 3 vertices and 0 leaves: stop growing there (budget 2 vertices, 0 leaves)",
        Sticks(three_at_least),
    ),
    Broken("the budget is never passed and a cut is told", "does not say that it was cut", Sticks(silent)),
    Broken("nothing is cut that has room", "is cut, though it has only", Sticks(cautious), "warning"),
    Broken(
        "the size parameter scales and does nothing else",
        "from 10 to 20 radius does not become 2 times as large",
        plants(lambda plant: bent(plant, radius=0 * plant.radius + 0.1)),
    ),
    Broken(
        "the age parameter counts years",
        "years is a float from 2",
        Sticks(space=space(years=Parameter("years", 2.0, 10.0, default=6.0))),
    ),
    Broken("the age parameter counts years", "the plant becomes lower", Sticks(shrinking), "warning"),
    Broken(
        "presets are plants of the generator",
        "oak is of sticks 2, this is sticks 1",
        Sticks(presets=preset(version="2")),
    ),
    Broken(
        "presets are plants of the generator",
        "no parameter 'hight'; did you mean 'height'?",
        Sticks(presets=preset(values={"hight": 3.0})),
    ),
    Broken(
        "every gene changes the plant", "1 of 5 change none of 12 plants: idle", Sticks(space=space(IDLE)), "warning"
    ),
    Broken(
        "most plants fit the budget",
        "plants are cut (budget 12 vertices, 12 leaves)",
        Sticks(),
        "warning",
        Budget(12, 12),
    ),
    Broken("heights are of one kind", "are units mixed up?", Sticks(mixed_units), "warning"),
]
