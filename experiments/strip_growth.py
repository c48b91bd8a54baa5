"""Growth along a parameter: which one a strip shows, at which values, and the plants there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from experiments.errors import UserError, did_you_mean
from experiments.settings import Strip
from experiments.sheet_cells import grow, same
from treefit.plant import Generator, Parameter, Plant, Value


@dataclass(frozen=True, eq=False)
class Growth:
    """The plant of `values` on `seed` at any value of `parameter`; nothing is grown twice."""

    generator: Generator
    parameter: Parameter
    values: Mapping[str, Value]
    seed: int
    _grown: dict[float, Plant | str] = field(default_factory=dict)

    @property
    def by_year(self) -> bool:
        """Whether the parameter is the age."""
        return self.parameter.name == self.generator.age_parameter

    @property
    def own(self) -> float:
        """Value of the parameter that the plant itself has."""
        return float(self.values[self.parameter.name])

    def at(self, value: float) -> Plant | str:
        """The plant there, or the reason why there is none."""
        if value not in self._grown:
            told: Value = int(value) if self.parameter.kind == "int" else value
            self._grown[value] = grow(self.generator, {**self.values, self.parameter.name: told}, self.seed)
        return self._grown[value]

    def ends(self) -> tuple[float, float]:
        """First and last value to show: year 1 to the year that ends the growth, or the lowest value to the own."""
        return (1.0, self._grown_up()) if self.by_year else (self.parameter.low, self.own)

    def _grown_up(self) -> float:
        """First year whose plant is that of the last, for what has ended to grow does not begin again."""
        if isinstance(self.at(self.own), str):
            return self.own
        young, old = 0, int(self.own)
        while old - young > 1:
            middle = (young + old) // 2
            if same(self.at(middle), self.at(self.own)):
                old = middle
            else:
                young = middle
        return float(old)

    def spaced(self, count: int) -> list[float]:
        """At most `count` values in equal steps, the last of them that of the plant itself; none twice."""
        first, last = self.ends()
        if count == 1:
            return [last]
        evenly = np.linspace(first, last, count)
        return list(dict.fromkeys((np.rint(evenly) if self.parameter.kind == "int" else evenly).tolist()))


def shown_parameter(generator: Generator, settings: Strip) -> Parameter | None:
    """Parameter that a strip goes along, None when there is to be no strip; UserError for one that cannot be."""
    name, known = settings.parameter or generator.age_parameter, generator.space.parameters
    if name is None:
        if settings.frames or settings.animation:
            raise UserError(f"strip: {generator.name} does not grow by years; strip.parameter=<name> shows another way")
        return None
    numbers = {parameter.name: parameter for parameter in known if parameter.kind in ("int", "float")}
    if name not in numbers:
        rule = "not a number" if name in [parameter.name for parameter in known] else "no parameter"
        raise UserError(f"strip.parameter: {rule}: {name!r}{did_you_mean(name, numbers)}")
    return numbers[name]
