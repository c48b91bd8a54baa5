"""SimpleGen: a simple set of rules for the recursive description of a tree (sec. 6)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from generators.simplegen.growth import STEM_FIELDS, children_of, grow_leaves, grow_level
from generators.simplegen.parameters import FIXED, NEUTRAL, SPACE
from treefit.plant import Budget, ParameterSpace, Plant, Value, Values


@dataclass(frozen=True)
class SimpleGen:
    """A straight branch per stem, at every joint past its bare part a child, at the last level leaves.

    `fixed` takes parameters out of the search; `additions=False` leaves the paper's 19 only.
    """

    fixed: Mapping[str, Value] = field(default_factory=lambda: dict(FIXED))
    additions: bool = True

    name: ClassVar[str] = "simplegen"
    version: ClassVar[str] = "1"
    parallel: ClassVar[str] = "threads"
    size_parameter: ClassVar[str | None] = "branch_len_0"

    def __post_init__(self) -> None:
        self.space  # noqa: B018 - names and values in `fixed` are checked at the border

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""
        neutral = {} if self.additions else NEUTRAL
        return SPACE.fix(**{**neutral, **self.fixed})

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name; its size is branch_len_0 metres of trunk."""
        counts = [int(values[f"branch_count_{level}"]) for level in range(int(values["levels"]))]
        starts = [float(values[f"branching_start_{level}"]) for level in range(len(counts))]
        whorls = [int(values["whorl"])] + [1] * (len(counts) - 1)
        stems = [1]
        for level in range(len(counts) - 1):
            stems.append(stems[-1] * children_of(counts[level], starts[level], whorls[level]))
        capacity = min(1 + sum(n * c for n, c in zip(stems, counts, strict=True)), budget.vertices)
        return _Growth(values, counts, starts, whorls, stems, capacity).grow(seed, budget.leaves)


class _Growth:
    """The arrays of one plant while it grows."""

    def __init__(
        self, values: Values, counts: list[int], starts: list[float], whorls: list[int], stems: list[int], capacity: int
    ) -> None:
        self.values, self.counts, self.starts, self.whorls, self.stems = values, counts, starts, whorls, stems
        self.xyz = np.zeros((3, capacity), np.float32)
        self.radius = np.zeros(capacity, np.float32)
        self.parent = np.full(capacity, -1, np.int32)
        self.level = np.zeros(capacity, np.int32)

    def grow(self, seed: int, max_leaves: int) -> Plant:
        """Grow level by level, then the leaves on the last one."""
        trunk = self._number("branch_len_0")
        lean = self._number("lean")
        self.radius[0] = trunk * self._number("branch_r_0")
        front = np.zeros((STEM_FIELDS, 1), np.float32)
        front[3:8, 0] = np.sin(lean), 0.0, np.cos(lean), trunk, self.radius[0]
        keys = np.array([seed], np.uint64)
        n, n_stems, cut, first = 1, 1, False, 1
        for level in range(len(self.counts)):
            first = n
            n, n_stems, cut, front, keys = self._grow_level(level, n, n_stems, front, keys)
            if cut:
                break
        return self._with_leaves(first, n, keys, trunk, 0 if cut else max_leaves, cut)

    def _grow_level(
        self, level: int, n: int, n_stems: int, front: NDArray[np.float32], keys: NDArray[np.uint64]
    ) -> tuple[int, int, bool, NDArray[np.float32], NDArray[np.uint64]]:
        last = level == len(self.counts) - 1
        child = min(level + 1, 3)
        room = 1 if last else min(self.stems[level + 1], len(self.radius))
        next_front, next_keys = np.empty((STEM_FIELDS, room), np.float32), np.empty(room, np.uint64)
        trunk = level == 0
        n, m, cut = grow_level(
            level, last, front, keys, n_stems, self._number(f"branch_len_{child}"), self._number(f"branch_angle_{level}"),
            self._number("branch_angle_change") if trunk else 0.0, self.counts[level], self.starts[level],
            self.whorls[level], self._number(f"branch_r_{child}"), self._number("taper"),
            0.0 if trunk else self._number("droop_1" if level == 1 else "droop_2"),
            self._number("trunk_bend") if trunk else 0.0, self._number("wobble") * (0.3 if trunk else 1.0),
            self._crown(), self._number("asymmetry") if trunk else 0.0, self._number("length_variation"),
            0.0 if trunk else self._number("shortening"), 0.002 * self._number("branch_len_0"), self.xyz, self.radius,
            self.parent, self.level, n, len(self.radius), next_front, next_keys,
        )  # fmt: skip
        return n, m, cut, (front if last else next_front), (keys if last else next_keys)

    def _with_leaves(
        self, first: int, n: int, keys: NDArray[np.uint64], trunk: float, max_leaves: int, cut: bool
    ) -> Plant:
        last = len(self.counts) - 1
        number = int(self.values["leaf_number"])
        room = min((n - first) * number, max_leaves)
        position, axis, normal = (np.empty((3, room), np.float32) for _ in range(3))
        size = np.empty((2, room), np.float32)
        length = self._number("leaf_size") * trunk
        k, leaves_cut = grow_leaves(
            first, n, self.xyz, self.parent, keys, self.counts[last], self.starts[last],
            self._number(f"branch_angle_{last}"), self._number("leaves_count"), number, length,
            length * self._number("leaf_width"), position, axis, normal, size, room,
        ) if room else (0, False)  # fmt: skip
        return Plant(
            self.xyz[:, :n].T, self.radius[:n], self.parent[:n], self.level[:n], position[:, :k].T, axis[:, :k].T,
            normal[:, :k].T, size[:, :k].T, cut=cut or leaves_cut,
        )  # fmt: skip

    def _crown(self) -> NDArray[np.float64]:
        names = ("crown_bottom", "crown_peak", "crown_top", "crown_power_low", "crown_power_high")
        return np.array([self._number(name) for name in names])

    def _number(self, name: str) -> float:
        return float(self.values[name])
