"""Network: a small regression that tells, for every output, a mean and how far off it may be.

Two hidden layers with leaky rectifiers; the loss is the negative logarithm of the likelihood of a normal distribution
(Nix & Weigend, "Estimating the mean and variance of the target probability distribution", 1994); Adam (Kingma & Ba,
2015) with a rate that falls as a cosine. A few thousand lines of a library are not needed for it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Layer = tuple[Floats, Floats]
"""Weights (a, b) and offsets (b,)."""

LEAK = np.float32(0.1)
NARROWEST, WIDEST = -4.0, 1.0
"""Logarithms of the least and the greatest standard deviation."""


@dataclass(frozen=True)
class Training:
    """How a network is trained; `noise` is added to the inputs, in standard deviations of them."""

    hidden: tuple[int, ...] = (192, 192)
    epochs: int = 16
    batch: int = 256
    rate: float = 2e-3
    noise: float = 0.05
    decay: float = 1e-4


def predict(layers: Sequence[Layer], inputs: Floats) -> tuple[Floats, Floats]:
    """Means and standard deviations (m, n) for inputs (m, f)."""
    out = _activations(layers, inputs)[-1]
    n = out.shape[1] // 2
    return out[:, :n], np.exp(np.clip(out[:, n:], NARROWEST, WIDEST))


def loss(layers: Sequence[Layer], inputs: Floats, wanted: Floats) -> float:
    """Mean negative log-likelihood, less its constant, of `wanted` (m, n) for inputs (m, f)."""
    mean, deviation = predict(layers, inputs)
    return float((0.5 * ((mean - wanted) / deviation) ** 2 + np.log(deviation)).mean())


def train(
    inputs: Floats, wanted: Floats, training: Training, seed: int, epochs: Iterable[int] | None = None
) -> list[Layer]:
    """Network for inputs (m, f) of mean 0 and deviation 1 and outputs (m, n).

    `epochs` is range(training.epochs) for those who want to count along. The same on the same kind of processor with
    one thread of linear algebra.
    """
    t = 0
    draw = np.random.default_rng([seed, 3])
    layers = _begin(inputs.shape[1], training.hidden, wanted.shape[1], draw)
    weights = [array for layer in layers for array in layer]
    drift, square = ([np.zeros_like(array) for array in weights] for _ in range(2))
    each = len(inputs) // training.batch or 1
    for _ in range(training.epochs) if epochs is None else epochs:
        order = draw.permutation(len(inputs))
        for rows in np.array_split(order, each):
            noisy = inputs[rows] + np.float32(training.noise) * draw.standard_normal(
                (len(rows), inputs.shape[1]), np.float32
            )
            gradients = _gradients(layers, noisy, wanted[rows])
            t += 1
            step = training.rate * 0.5 * (1 + np.cos(np.pi * t / (each * training.epochs)))
            for array, gradient, m, v in zip(weights, gradients, drift, square, strict=True):
                m += np.float32(0.1) * (gradient - m)
                v += np.float32(0.001) * (gradient * gradient - v)
                way = m / np.float32(1 - 0.9**t) / (np.sqrt(v / np.float32(1 - 0.999**t)) + np.float32(1e-8))
                array -= np.float32(step) * (way + np.float32(training.decay if array.ndim == 2 else 0) * array)
    return layers


def _begin(f: int, hidden: Sequence[int], n: int, draw: np.random.Generator) -> list[Layer]:
    """Layers that know nothing: a mean of 0.5 and the deviation of a uniform gene for every output."""
    sizes, layers = (f, *hidden), []
    for a, b in pairwise(sizes):
        layers.append((draw.standard_normal((a, b), np.float32) * np.float32((2 / a) ** 0.5), np.zeros(b, np.float32)))
    last = draw.standard_normal((sizes[-1], 2 * n), np.float32) * np.float32(0.1 * (2 / sizes[-1]) ** 0.5)
    return [*layers, (last, np.repeat(np.array([0.5, np.log(12**-0.5)], np.float32), n))]


def _activations(layers: Sequence[Layer], inputs: Floats) -> list[Floats]:
    """Inputs (m, f), and outputs of every layer."""
    found = [inputs]
    for i, (weights, offsets) in enumerate(layers):
        out = found[-1] @ weights + offsets
        found.append(out if i == len(layers) - 1 else np.maximum(out, LEAK * out))
    return found


def _gradients(layers: Sequence[Layer], inputs: Floats, wanted: Floats) -> list[Floats]:
    """Gradient of the loss by the weights and offsets of every layer, in order."""
    found = _activations(layers, inputs)
    n = wanted.shape[1]
    width = found[-1][:, n:]
    inverse = np.exp(-np.clip(width, NARROWEST, WIDEST))
    off = (found[-1][:, :n] - wanted) * inverse
    free = (width > NARROWEST) & (width < WIDEST)
    back: Any = np.concatenate([off * inverse, (1 - off * off) * free], axis=1) / np.float32(wanted.size)
    gradients: list[Floats] = []
    for i in range(len(layers) - 1, -1, -1):
        gradients += [back.sum(axis=0), found[i].T @ back]
        if i:
            back = (back @ layers[i][0].T) * np.where(found[i] > 0, np.float32(1), LEAK).astype(np.float32)
    return gradients[::-1]
