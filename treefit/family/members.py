"""Members of the family: objective functions of several targets that share everything else, one plant seen by all."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from treefit.family.features import features
from treefit.mask import Mask
from treefit.objective import REDUCE, View
from treefit.placing import place
from treefit.plant import Budget, Generator, Genome, ParameterSpace, check_plant
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity
from treefit.view.frame import BitMask, Frame, frame_for, sample


@dataclass(frozen=True, eq=False)
class Seen:
    """What the family sees of one plant: `scores` (t,), features of its mask (f,), counts; None for no usable plant."""

    scores: NDArray[np.float32]
    features: NDArray[np.float32] | None = None
    vertices: int = 0
    leaves: int = 0


@dataclass(frozen=True, eq=False)
class Members:
    """Scores of a plant for each of t `targets`, described masks in one `frame`, with `wishes` of their own."""

    generator: Generator
    space: ParameterSpace
    view: View
    frame: Frame
    similarity: Similarity[Any]
    targets: tuple[object, ...]
    wishes: tuple[Characteristics, ...]
    budget: Budget

    @classmethod
    def of(
        cls, masks: Sequence[Mask], wishes: Sequence[Characteristics], generator: Generator, view: View,
        similarity: Similarity[Any],
    ) -> Members:  # fmt: skip
        """Members for `masks` (h, w) of trees, in a frame that is wide enough for all."""
        frame = max((frame_for(mask, view.resolution) for mask in masks), key=lambda one: one.words)
        targets = tuple(similarity.describe(BitMask.pack(sample(mask, frame))) for mask in masks)
        wishes = tuple(wish.for_picture(place(mask).width) for wish, mask in zip(wishes, masks, strict=True))
        space = generator.space
        if generator.size_parameter is not None and any(wish.sees_size for wish in wishes):
            space = space.release(generator.size_parameter)
        most = [wish.budget for wish in wishes]
        budget = Budget(max(one.vertices for one in most), max(one.leaves for one in most))
        return cls(generator, space, view, frame, similarity, targets, wishes, budget)

    def __len__(self) -> int:
        """Count of targets t."""
        return len(self.targets)

    def __call__(self, genome: Genome, seed: int) -> Seen:
        """Scores of the plant of `genome` (n,) on `seed`; 0 for all when it fails."""
        try:
            plant = self.generator(self.space.decode(genome), seed, self.budget)
            check_plant(plant)
            sides = [] if plant.cut else self.view.sides(plant, self.frame)
        except Exception:  # a foreign generator may raise anything; in a search such a genome scores 0
            return Seen(np.zeros(len(self), np.float32))
        if plant.cut:
            return Seen(np.zeros(len(self), np.float32))
        found = [self.similarity.describe(side) for side in sides]
        scores = np.zeros(len(self), np.float32)
        for i, (target, wish) in enumerate(zip(self.targets, self.wishes, strict=True)):
            limit = wish.budget
            if plant.n_vertices > limit.vertices or plant.n_leaves > limit.leaves:
                continue
            image = REDUCE[self.view.reduce]([self.similarity.compare(target, one) for one in found])
            scores[i] = image * math.prod(wish.multipliers(plant).values())
        return Seen(np.nan_to_num(scores), features(sides[0]), plant.n_vertices, plant.n_leaves)
