"""Parameters of a generator and their map to the unit cube in which the search lives (sec. 3)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches

import numpy as np
from numpy.typing import NDArray

Value = float | int | bool | str
Values = Mapping[str, Value]
Genome = NDArray[np.float64]  # (n,) in [0, 1]

SCALES = ("linear", "log")
KINDS = ("float", "int", "bool", "choice")


@dataclass(frozen=True)
class Parameter:
    """One number or choice that a generator takes, in `unit`, searched in [low, high]."""

    name: str
    low: float = 0.0
    high: float = 1.0
    default: Value = 0.0
    unit: str = ""
    scale: str = "linear"  # linear | log
    kind: str = "float"  # float | int | bool | choice
    choices: tuple[str, ...] = ()
    doc: str = ""

    def __post_init__(self) -> None:
        if self.kind not in KINDS or self.scale not in SCALES:
            raise ValueError(f"parameter {self.name!r}: kind must be one of {KINDS}, scale one of {SCALES}")
        if self.kind in ("float", "int") and not self.low < self.high:
            raise ValueError(f"parameter {self.name!r}: low must be under high, got [{self.low}, {self.high}]")
        if self.scale == "log" and self.low <= 0:
            raise ValueError(f"parameter {self.name!r}: a log scale needs low > 0, got {self.low}")
        if self.kind == "choice" and len(self.choices) < 2:
            raise ValueError(f"parameter {self.name!r}: needs two choices or more, got {self.choices}")
        self.check(self.default)

    def decode(self, gene: float) -> Value:
        """Value at `gene` in [0, 1]; ints, bools and choices share the interval in equal parts."""
        gene = min(max(float(gene), 0.0), 1.0)
        if self.kind == "bool":
            return gene >= 0.5
        if self.kind == "choice":
            return self.choices[min(int(gene * len(self.choices)), len(self.choices) - 1)]
        low, high = (self.low, self.high + 1) if self.kind == "int" else (self.low, self.high)
        if self.scale == "log":
            value = low * math.exp(gene * math.log(high / low))
        else:
            value = low + gene * (high - low)
        return min(int(value + 1e-9), int(self.high)) if self.kind == "int" else min(max(value, low), high)

    def encode(self, value: Value) -> float:
        """Gene in [0, 1] that decodes to `value` (clipped into the range)."""
        self.check(value)
        if self.kind == "bool":
            return 0.75 if value else 0.25
        if self.kind == "choice":
            return (self.choices.index(str(value)) + 0.5) / len(self.choices)
        number, low, high = float(value), self.low, self.high
        if self.kind == "int":
            number, high = number + 0.5, high + 1
        number = min(max(number, low), high)
        if self.scale == "log":
            return math.log(number / low) / math.log(high / low)
        return (number - low) / (high - low)

    def check(self, value: Value) -> None:
        """Raise ValueError when `value` is not of this kind; a number outside the search range is allowed."""
        if self.kind == "choice":
            if value not in self.choices:
                raise ValueError(f"parameter {self.name!r}: must be one of {', '.join(self.choices)}, got {value!r}")
        elif self.kind == "bool":
            if not isinstance(value, bool):
                raise ValueError(f"parameter {self.name!r}: must be true or false, got {value!r}")
        elif isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise ValueError(f"parameter {self.name!r}: must be a finite number, got {value!r}")
        elif self.kind == "int" and value != int(value):
            raise ValueError(f"parameter {self.name!r}: must be a whole number, got {value!r}")


@dataclass(frozen=True)
class ParameterSpace:
    """Parameters of a generator; those named in `fixed` keep their value and are no genes."""

    parameters: tuple[Parameter, ...]
    fixed: Mapping[str, Value] = field(default_factory=dict)

    def __post_init__(self) -> None:
        known = {parameter.name: parameter for parameter in self.parameters}
        if len(known) != len(self.parameters):
            raise ValueError("parameter names must differ from each other")
        for name, value in self.fixed.items():
            self._known(name).check(value)

    @property
    def free(self) -> tuple[Parameter, ...]:
        """Parameters that are genes, in order."""
        return tuple(parameter for parameter in self.parameters if parameter.name not in self.fixed)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the genes, in order."""
        return tuple(parameter.name for parameter in self.free)

    def __len__(self) -> int:
        """Count of genes n."""
        return len(self.free)

    def decode(self, genome: Genome) -> dict[str, Value]:
        """Values by name, fixed ones included, at `genome` (n,)."""
        if len(genome) != len(self):
            raise ValueError(f"genome must have {len(self)} genes, got {len(genome)}")
        genes = iter(genome)
        return {
            parameter.name: self.fixed[parameter.name] if parameter.name in self.fixed
            else parameter.decode(next(genes))
            for parameter in self.parameters
        }  # fmt: skip

    def encode(self, values: Values) -> Genome:
        """Genome (n,) nearest to `values`; names that are missing take their default."""
        for name in values:
            self._known(name)
        return np.array([p.encode(values.get(p.name, p.default)) for p in self.free], dtype=np.float64)

    def complete(self, values: Values) -> dict[str, Value]:
        """All values by name: the given ones, else the fixed ones, else the defaults; ValueError for bad ones."""
        for name, value in values.items():
            self._known(name).check(value)
        return {p.name: values.get(p.name, self.fixed.get(p.name, p.default)) for p in self.parameters}

    def fix(self, **values: Value) -> ParameterSpace:
        """Return this space with further parameters fixed."""
        return replace(self, fixed={**self.fixed, **values})

    def release(self, *names: str) -> ParameterSpace:
        """Return this space with `names` free again."""
        return replace(self, fixed={name: value for name, value in self.fixed.items() if name not in names})

    def _known(self, name: str) -> Parameter:
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        close = get_close_matches(name, [parameter.name for parameter in self.parameters], n=1)
        raise ValueError(f"no parameter {name!r}" + (f"; did you mean {close[0]!r}?" if close else ""))
