"""The normal distribution that CMA-ES adapts, and its two moves: draw steps, learn from them.

Formulas and names of constants are those of N. Hansen, "The CMA Evolution Strategy: A Tutorial" (arXiv:1604.00772).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Gaussian:
    """N(mean, sigma^2 C); `axes` (n, n), in columns, and `lengths` (n,) are of a C some generations old."""

    mean: Floats  # (n,)
    sigma: float
    covariance: Floats  # C (n, n)
    axes: Floats
    lengths: Floats
    sigma_path: Floats  # (n,)
    covariance_path: Floats  # (n,)
    generation: int

    @property
    def spread(self) -> Floats:
        """Standard deviation (n,) of every coordinate."""
        return self.sigma * np.sqrt(np.diag(self.covariance))


@dataclass(frozen=True, eq=False)
class Rates:
    """Weights (m,) by rank, best first, and the rates of learning (table 1)."""

    weights: Floats
    effective: float  # mu_eff
    sigma_path: float  # c_sigma
    damping: float  # d_sigma
    covariance_path: float  # c_c
    rank_one: float  # c_1
    rank_mu: float  # c_mu


def around(mean: Floats, sigma: float) -> Gaussian:
    """Round distribution that has learnt nothing yet."""
    n = len(mean)
    return Gaussian(mean, sigma, np.eye(n), np.eye(n), np.ones(n), np.zeros(n), np.zeros(n), 0)


def rates(n: int, population: int) -> Rates:
    """Those of the tutorial, with negative weights for the worse half (eq. 49 to 58)."""
    raw = np.log((population + 1) / 2) - np.log(np.arange(1, population + 1))
    good, bad = np.maximum(raw, 0), np.maximum(-raw, 0)
    mu, mu_bad = (float(w.sum() ** 2 / (w**2).sum()) for w in (good, bad))
    one = 2 / ((n + 1.3) ** 2 + mu)
    many = min(1 - one, 2 * (0.25 + mu + 1 / mu - 2) / ((n + 2) ** 2 + mu))
    negative = min(1 + one / many, 1 + 2 * mu_bad / (mu + 2), (1 - one - many) / (n * many))
    path = (mu + 2) / (n + mu + 5)
    return Rates(
        weights=good / good.sum() - negative * bad / bad.sum(),
        effective=mu,
        sigma_path=path,
        damping=1 + 2 * max(0.0, float(np.sqrt((mu - 1) / (n + 1))) - 1) + path,
        covariance_path=(4 + mu / n) / (n + 4 + 2 * mu / n),
        rank_one=one,
        rank_mu=many,
    )


def learn(gaussian: Gaussian, rate: Rates, normals: Floats) -> Gaussian:
    """Distribution after one generation, from its standard normal draws (m, n), best first."""
    n, g = len(gaussian.mean), gaussian.generation + 1
    steps = directions(gaussian, normals)
    good = np.maximum(rate.weights, 0)
    step, turned = good @ steps, gaussian.axes @ (good @ normals)
    keep, expected = 1 - rate.sigma_path, np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n))
    sigma_path = keep * gaussian.sigma_path + np.sqrt((1 - keep**2) * rate.effective) * turned
    length = float(np.linalg.norm(sigma_path)) / expected
    short = length / np.sqrt(1 - keep ** (2 * g)) < 1.4 + 2 / (n + 1)  # else the path would blow up C
    fade = rate.covariance_path * (2 - rate.covariance_path)
    path = (1 - rate.covariance_path) * gaussian.covariance_path + short * np.sqrt(fade * rate.effective) * step
    longs = np.maximum((normals**2).sum(axis=1), 1e-9)
    weights = np.where(rate.weights < 0, rate.weights * n / longs, rate.weights)  # C stays positive definite
    old = 1 - rate.rank_one - rate.rank_mu * rate.weights.sum() + rate.rank_one * (not short) * fade
    covariance = (
        old * gaussian.covariance + rate.rank_one * np.outer(path, path) + rate.rank_mu * (steps.T * weights) @ steps
    )
    sigma = gaussian.sigma * float(np.exp(min(1.0, rate.sigma_path / rate.damping * (length - 1))))
    learnt = Gaussian(gaussian.mean + gaussian.sigma * step, sigma, covariance, gaussian.axes, gaussian.lengths,
                      sigma_path, path, g)  # fmt: skip
    every = max(1, int(1 / (10 * n * (rate.rank_one + rate.rank_mu))))
    return _turned(learnt) if g % every == 0 else learnt


def directions(gaussian: Gaussian, normals: Floats) -> Floats:
    """Standard normal draws (m, n) as steps in units of sigma."""
    steps: Floats = (normals * gaussian.lengths) @ gaussian.axes.T
    return steps


def _turned(gaussian: Gaussian) -> Gaussian:
    """With axes and lengths of the covariance as it is now."""
    covariance = (gaussian.covariance + gaussian.covariance.T) / 2
    squares, axes = np.linalg.eigh(covariance)
    return replace(gaussian, covariance=covariance, axes=axes, lengths=np.sqrt(np.maximum(squares, 1e-14)))
