"""Generator: the one thing that the search asks of a procedural plant generator (sec. 3)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from treefit.plant.parameters import ParameterSpace, Values
from treefit.plant.plant import Plant
from treefit.plant.preset import Preset


@dataclass(frozen=True)
class Budget:
    """Counts at which a generator must stop growing; the plant then says that it was cut."""

    vertices: int = 50_000
    leaves: int = 100_000

    def __post_init__(self) -> None:
        if self.vertices < 2 or self.leaves < 0:
            raise ValueError(f"budget: needs vertices >= 2 and leaves >= 0, got {self.vertices}, {self.leaves}")


class Generator(Protocol):
    """A function of (values, seed, budget): the same input is to give the same bytes."""

    @property
    def name(self) -> str:
        """Name of the generator, as presets carry it."""

    @property
    def version(self) -> str:
        """Changes whenever the same values and seed give another plant."""

    @property
    def parallel(self) -> str:
        """How several calls run at once: "threads" when the work releases the GIL, else "processes"."""

    @property
    def pure(self) -> bool:
        """Whether the same input surely gives the same bytes, or the same failure; a foreign program only may.

        Where it is False, a search grows every new best plant a second time before it believes its score.
        """

    @property
    def size_parameter(self) -> str | None:
        """Parameter that sets the size in metres, which no picture can see, and nothing else; None when there is none.

        The plant is as many times as large as its value: all positions and radii. Lengths of leaves go with it, or have
        a parameter of their own.
        """

    @property
    def age_parameter(self) -> str | None:
        """Parameter that counts the years of growth, whole and from 1; None for a plant that does not grow by years.

        With all else equal a plant of fewer years is the same one when it was younger. Growth may end by itself: from
        then on more years change nothing.
        """

    @property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes."""

    @property
    def presets(self) -> Mapping[str, Preset]:
        """Plants of this generator by name; empty when there are none."""

    @property
    def family(self) -> Path | None:
        """Folder of the files that task=statistics has written for this generator; None when there is none."""

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name; every draw comes from streams keyed by `seed`."""
