"""Guess: what the look of a target tells of the genome, by a network trained on random plants (amortised start).

Plants that `task=statistics` grows are pairs of features and genome. From the features of a target and the wished
vertices the network says for every gene a mean and how far off it may be; how genes go together is the correlation of
its errors on plants that it has not seen.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from treefit.family.files import array, read_arrays, write_arrays
from treefit.family.identity import StaleError, Tied, describe, fitting
from treefit.family.network import Floats, Layer, Training, loss, predict, train
from treefit.plant import Generator, ParameterSpace

KINDS = ("weights", "offsets")
FAR = 4.0
"""Features farther than so many deviations from the mean count as that far: no plant like this was seen."""
FEWEST = 100
"""Vertices of a plant from which something can be learnt."""
UNSEEN = 10
"""Every so manieth plant is not learnt from, but used to see how far off the guesses are."""
UNKNOWN = 12**-0.5
"""Deviation of a gene of which nothing is known."""


@dataclass(frozen=True, eq=False)
class Guess(Tied):
    """Network of one generator.

    `middle`, `width` (f,): mean and deviation of the inputs, the features and the logarithm of the count of vertices;
    `correlation` (n, n) of the errors; `missed`: mean negative log-likelihood of plants not learnt from (a uniform
    guess has -0.74).
    """

    middle: Floats
    width: Floats
    layers: list[Layer]
    correlation: Floats
    missed: float

    def __post_init__(self) -> None:
        super().__post_init__()
        n, f = len(self.genes), len(self.middle)
        sizes = [f, *(offsets.size for _, offsets in self.layers)]
        shapes = [(weights.shape, offsets.shape) for weights, offsets in self.layers]
        if shapes != [((a, b), (b,)) for a, b in pairwise(sizes)] or sizes[-1] != 2 * n:
            raise ValueError("layers do not fit each other")
        if self.width.shape != (f,) or not (self.width > 0).all() or self.correlation.shape != (n, n):
            raise ValueError("width or correlation has another shape")
        numbers = [self.middle, self.width, self.correlation, *(array for layer in self.layers for array in layer)]
        if not all(np.isfinite(array).all() for array in numbers):
            raise ValueError("a number is not finite")

    def __call__(self, features: Floats, vertices: float | None) -> tuple[Floats, Floats]:
        """Mean and deviation (n,) of the genes for features (f,) and a wished count of vertices, None for any."""
        size = self.middle[-1] if vertices is None else np.float32(np.log(vertices))
        inputs = np.clip((np.append(features, size) - self.middle) / self.width, -FAR, FAR)
        mean, deviation = predict(self.layers, inputs[None].astype(np.float32))
        return np.clip(mean[0], 0, 1), deviation[0]

    def for_space(
        self, space: ParameterSpace, features: Floats, vertices: float | None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Mean, deviation (n,) and correlation (n, n) of the genes of `space`; of unknown ones nothing is known.

        StaleError when a gene had another range or kind, or the features of a mask are others now.
        """
        at = self.places(space)
        if len(features) + 1 != len(self.middle):
            raise StaleError(f"{len(features)} features of a mask now, {len(self.middle) - 1} then", self.generator)
        mean, deviation = self(features, vertices)
        n = len(self.genes)
        both = np.eye(n + 1)
        both[:n, :n] = self.correlation
        joint = both[np.ix_(at, at)]
        np.fill_diagonal(joint, 1.0)
        return np.append(mean, 0.5)[at], np.append(deviation, UNKNOWN)[at], joint

    def write(self, path: Path) -> None:
        """Write to `path`, weights in two bytes each, at once or not at all."""
        head = {name: getattr(self, name) for name in ("generator", "version", "genes", "missed")}
        arrays = {f"{kind}_{i}": array.astype(np.float16) for i, layer in enumerate(self.layers)
                  for kind, array in zip(KINDS, layer, strict=True)}  # fmt: skip
        arrays["correlation"] = self.correlation.astype(np.float16)
        write_arrays(path, {**head, "layers": len(self.layers)}, {**arrays, "middle": self.middle, "width": self.width})

    @classmethod
    def read(cls, path: Path) -> Guess:
        """Guess in `path`; FamilyError when the file is damaged, FileNotFoundError when there is none."""
        return read_arrays(path, "guess", cls._made)

    @classmethod
    def _made(cls, head: Any, arrays: Mapping[str, NDArray[Any]]) -> Guess:
        layers = [tuple(array(arrays, f"{kind}_{i}", np.float16).astype(np.float32) for kind in KINDS)
                  for i in range(head["layers"])]  # fmt: skip
        middle, width = (array(arrays, name, np.float32) for name in ("middle", "width"))
        correlation = array(arrays, "correlation", np.float16).astype(np.float32)
        return cls(str(head["generator"]), str(head["version"]), tuple(map(dict, head["genes"])), middle, width,
                   cast(list[Layer], layers), correlation, float(head["missed"]))  # fmt: skip


def learn_guess(
    generator: Generator, space: ParameterSpace, genomes: NDArray[np.float64], features: NDArray[np.float16],
    vertices: NDArray[np.int32], seed: int, training: Training | None = None,
    epochs: Iterable[int] | None = None,
) -> Guess:  # fmt: skip
    """Guess from plants: genomes (m, n) of `space`, features (m, f) of their masks, counts of vertices (m,)."""
    seen = vertices >= FEWEST
    wanted = genomes[seen].astype(np.float32)
    given = np.column_stack([features[seen], np.log(vertices[seen])]).astype(np.float32)
    middle, width = given.mean(axis=0), np.maximum(given.std(axis=0), np.float32(0.02))
    inputs = np.clip((given - middle) / width, -FAR, FAR).astype(np.float32)
    held = np.arange(len(inputs)) % UNSEEN == 0
    layers = train(inputs[~held], wanted[~held], training or Training(), seed, epochs)
    mean, deviation = predict(layers, inputs[held])
    correlation = np.corrcoef(((wanted[held] - mean) / deviation).T).astype(np.float32)
    return Guess(generator.name, generator.version, tuple(describe(gene) for gene in space.free), middle, width, layers,
                 correlation, loss(layers, inputs[held], wanted[held]))  # fmt: skip


def find_guess(generator: Generator) -> Guess | None:
    """Guess in `generator.family` (guess*.npz); None when none is for its space, StaleError for another version."""
    if generator.family is None:
        return None
    return fitting([(path.name, Guess.read(path)) for path in sorted(generator.family.glob("guess*.npz"))], generator)
