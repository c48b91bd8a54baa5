"""The normal distribution of CMA-ES and its two moves: draw steps, learn from them.

Its covariance is D C D: the scales D of the coordinates learn fast, what they have to do with each other, C, slowly
(Akimoto & Hansen, "Diagonal acceleration for covariance matrix adaptation evolution strategies", 2019, and Hansen's
tutorial, arXiv:1604.00772, for the rest). A plain CMA-ES learns both as slowly as C.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

TURN_EVERY = 5
"""Generations between two decompositions of C, the dearest step; in one, about a hundredth of C is renewed."""

FEW = 10
"""Coordinates under which a generation renews so much of C that it is decomposed in each: it soon is no covariance."""

WIDEST = 1e3
"""Of sigma and of a scale: where nothing is learnt, or of one coordinate alone, they drift out of all numbers."""


@dataclass(frozen=True, eq=False)
class Gaussian:
    """N(mean, sigma^2 D C D) for n coordinates, with the paths that its mean has gone lately."""

    mean: Floats  # (n,)
    sigma: float
    scale: Floats  # diagonal of D (n,)
    covariance: Floats  # C (n, n)
    axes: Floats  # (n, n), in columns, of C some generations ago
    lengths: Floats  # (n,) of the axes
    sigma_path: Floats  # (n,)
    scale_path: Floats  # (n,)
    covariance_path: Floats  # (n,)
    generation: int

    @property
    def spread(self) -> Floats:
        """Standard deviation (n,) of every coordinate."""
        return self.sigma * self.scale * np.sqrt(np.diag(self.covariance))

    def steps(self, normals: Floats) -> Floats:
        """Standard normal draws (m, n) as draws of N(0, C)."""
        drawn: Floats = (normals @ self.axes * self.lengths) @ self.axes.T
        return drawn

    def place(self, steps: Floats) -> Floats:
        """Where steps (m, n) of N(0, C) lead."""
        return self.mean + self.sigma * self.scale * steps


@dataclass(frozen=True, eq=False)
class Rate:
    """Weights (m,) by rank, best first, and how fast a matrix learns: from its path, from the steps, and the path."""

    weights: Floats
    one: float
    many: float
    path: float


@dataclass(frozen=True, eq=False)
class Rates:
    """Everything that follows from the counts of coordinates and of draws."""

    good: Floats  # weights (m,) of the better half, which sum up to 1
    effective: float  # how many draws they stand for
    sigma_path: float
    damping: float
    scale: Rate
    covariance: Rate


def around(mean: Floats, sigma: float) -> Gaussian:
    """Round distribution that has learnt nothing yet."""
    n, zero = len(mean), np.zeros(len(mean))
    return Gaussian(mean, sigma, np.ones(n), np.eye(n), np.eye(n), np.ones(n), zero, zero, zero, 0)


def rates(n: int, population: int) -> Rates:
    """Rates of both papers for `n` coordinates; the worse half has negative weights."""
    raw = np.log((population + 1) / 2) - np.log(np.arange(1, population + 1))
    good, bad = np.maximum(raw, 0), np.maximum(-raw, 0)
    mu, mu_bad = (float(w.sum() ** 2 / (w**2).sum()) for w in (good, bad))
    good, bad = good / good.sum(), bad / bad.sum()

    def rate(freedom: float, room: float) -> Rate:
        most = mu + 1 / mu - 2 + population / (2 * population + 10)
        one = 1 / (2 * (freedom / n + 1) * (n + 1) ** 0.75 + mu / 2)
        many = min(most * one, 0.9 - one)
        away = min(1 + one / many, 1 + 2 * mu_bad / (mu + 2), (1 - one - many) / (n * many) if room else np.inf)
        return Rate(good - away * bad, one, many, float(np.sqrt(most * one)) / 2)

    path = (mu + 2) / (n + mu + 5)
    damping = 1 + 2 * max(0.0, float(np.sqrt((mu - 1) / (n + 1))) - 1) + path
    return Rates(good, mu, path, damping, rate(n, 0), rate(n * (n + 1) / 2, 1))


def learn(gaussian: Gaussian, rates: Rates, normals: Floats) -> Gaussian:
    """Distribution after one generation, from its standard normal draws (m, n), best first."""
    g, n, generation = gaussian, len(gaussian.mean), gaussian.generation + 1
    steps, keep = g.steps(normals), 1 - rates.sigma_path
    step = rates.good @ steps
    sigma_path = keep * g.sigma_path + np.sqrt((1 - keep**2) * rates.effective) * (rates.good @ normals)
    length = float(np.linalg.norm(sigma_path)) / (np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n)))
    calm = length / np.sqrt(1 - keep ** (2 * generation)) < 1.4 + 2 / (n + 1)  # a leap must not blow up C and D
    moved = calm * np.sqrt(rates.effective) * g.scale * step
    scale_path, covariance_path = (
        (1 - rate.path) * path + np.sqrt(rate.path * (2 - rate.path)) * moved
        for path, rate in ((g.scale_path, rates.scale), (g.covariance_path, rates.covariance))
    )
    far = n / np.maximum((normals**2).sum(axis=1), 1e-9)
    learnt = replace(
        g,
        mean=g.place(step),
        sigma=min(g.sigma * float(np.exp(min(1.0, rates.sigma_path / rates.damping * (length - 1)))), WIDEST),
        scale=np.minimum(g.scale * np.exp(np.minimum(_growth(g, rates.scale, normals, far, scale_path), 1)), WIDEST),
        covariance=_covariance(g, rates.covariance, steps, far, covariance_path),
        sigma_path=sigma_path, scale_path=scale_path, covariance_path=covariance_path, generation=generation,
    )  # fmt: skip
    return _turned(learnt) if n < FEW or generation % TURN_EVERY == 0 else learnt


def _growth(g: Gaussian, rate: Rate, normals: Floats, far: Floats, path: Floats) -> Floats:
    """Logarithm (n,) of what D is multiplied with; less the longer C is in one direction, for then C knows better."""
    weights = np.where(rate.weights < 0, rate.weights * far, rate.weights)
    straight = g.axes @ (g.axes.T @ (path / g.scale) / g.lengths)
    slow = max(1.0, float(g.lengths.max() / g.lengths.min()) - 1)
    growth: Floats = (rate.one * (straight**2 - 1) + rate.many * (weights @ (normals**2 - 1))) / (2 * slow)
    return growth


def _covariance(g: Gaussian, rate: Rate, steps: Floats, far: Floats, path: Floats) -> Floats:
    """C from the old one, the path and the steps; the far ones of the worse half are shortened to keep it positive."""
    weights = np.where(rate.weights < 0, rate.weights * far, rate.weights)
    bent, old = path / g.scale, 1 - rate.one - rate.many * weights.sum()
    new: Floats = old * g.covariance + rate.one * np.outer(bent, bent) + rate.many * (steps.T * weights) @ steps
    return new


def _turned(g: Gaussian) -> Gaussian:
    """The same distribution with ones on the diagonal of C and up-to-date axes."""
    deviation = np.sqrt(np.diag(g.covariance))
    covariance = g.covariance / np.outer(deviation, deviation)
    squares, axes = np.linalg.eigh((covariance + covariance.T) / 2)
    lengths = np.sqrt(np.maximum(squares, 1e-12))
    axes = np.ascontiguousarray(axes)  # as it comes out of a checkpoint: the order of sums is the same then
    return replace(g, scale=g.scale * deviation, covariance=covariance, axes=axes, lengths=lengths)
