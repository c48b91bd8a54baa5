"""Parameters of a generator and their map to the unit cube in which the search lives (sec. 3)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import cached_property, partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Value = float | int | bool | str
Values = Mapping[str, Value]
Genome = NDArray[np.float64]  # (n,) in [0, 1]
Line: TypeAlias = tuple[float, float, float | None, float, bool, Callable[[float], Value] | None]
Decoder: TypeAlias = tuple[str, float, float, float | None, float, bool, Callable[[float], Value] | None]

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
    least: float = -math.inf  # values beyond these make no plant, though a preset may leave the range of the search
    most: float = math.inf

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
        return ParameterSpace((self,)).decode(np.array([gene]))[self.name]

    @property
    def line(self) -> Line:
        """How a gene becomes a value: low, span, rate of a log scale, most, whether whole; or another function."""
        if self.kind == "bool":
            return 0.0, 0.0, None, 0.0, False, _flag
        if self.kind == "choice":
            return 0.0, 0.0, None, 0.0, False, partial(_choice, self.choices)
        whole = self.kind == "int"
        span = self.high + 1 - self.low if whole else self.high - self.low
        rate = math.log((self.low + span) / self.low) if self.scale == "log" else None
        return self.low, span, rate, int(self.high) if whole else self.high, whole, None

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
        elif not self.least <= value <= self.most:
            limit = f"at least {self.least:g}" if value < self.least else f"at most {self.most:g}"
            raise ValueError(f"parameter {self.name!r}: must be {limit}, got {value!r}")


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

    @cached_property
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
        if len(genome) != len(self._decoders):
            raise ValueError(f"genome must have {len(self)} genes, got {len(genome)}")
        genes = genome.tolist()
        if min(genes, default=0.0) < 0.0 or max(genes, default=1.0) > 1.0:
            genes = np.clip(genome, 0.0, 1.0).tolist()
        values = self._skeleton.copy()
        for (name, low, span, rate, high, whole, other), gene in zip(self._decoders, genes, strict=True):
            if other is not None:
                values[name] = other(gene)
                continue
            number = low + gene * span if rate is None else low * math.exp(gene * rate)
            if whole:
                number = int(number + 1e-9)
            values[name] = number if number < high else high
        return values

    @cached_property
    def _skeleton(self) -> dict[str, Value]:
        """All names in order, fixed values in their places."""
        return {parameter.name: self.fixed.get(parameter.name, 0.0) for parameter in self.parameters}

    @cached_property
    def _decoders(self) -> list[Decoder]:
        return [(parameter.name, *parameter.line) for parameter in self.free]

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


def _flag(gene: float) -> bool:
    return gene >= 0.5


def _choice(choices: tuple[str, ...], gene: float) -> str:
    return choices[min(int(gene * len(choices)), len(choices) - 1)]
