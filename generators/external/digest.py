"""Digest: a number by which a plant is known again, so that one that is grown twice can be held against itself."""

from __future__ import annotations

import threading
from collections import OrderedDict

import numpy as np

from generators.external.faults import NotDeterministic
from treefit.plant import Plant, Values

KEPT = 200_000
"""Plants that are remembered, the last ones."""


class Digests:
    """Remembers the plant of every input; what comes out another time must be the same."""

    def __init__(self) -> None:
        self._known: OrderedDict[int, int] = OrderedDict()
        self._lock = threading.Lock()

    def check(self, values: Values, seed: int, plant: Plant) -> None:
        """Remember `plant`; NotDeterministic when `values` and `seed` have given another one before."""
        key, found = hash((seed, *values.items())), digest(plant)
        with self._lock:
            known = self._known.setdefault(key, found)
            if len(self._known) > KEPT:
                self._known.popitem(last=False)
        if known != found:
            raise NotDeterministic("the same values and seed gave another plant than before")


def digest(plant: Plant) -> int:
    """Number that two plants share when all of their arrays are the same bytes, and hardly otherwise."""
    place, position, axis, normal, size = plant.rows
    rows = (*place, plant.radius, plant.parent, plant.level, *position, *axis, *normal, *size)
    return hash(tuple(int(row.view(np.int32).sum(dtype=np.int64)) for row in rows))
