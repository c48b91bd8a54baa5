"""How faithful a view is: scores and pixels of many random plants, by the view and by the naive one at 512 rows.

A search only asks which of two plants is better, so what counts is the rank correlation (Spearman) of the scores; over
all plants, and within the best half, where a search spends its time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import spearmanr

from experiments.zbuffer_view import zbuffer_mask
from treefit.mask import Mask
from treefit.objective import View
from treefit.plant import Budget, Generator, Plant, check_plant
from treefit.similarity import Similarity
from treefit.view import BitMask, Frame, frame_for, sample

REFERENCE_ROWS = 512
LEAST_ROWS = 64  # frames of all heights are as wide as one of that many rows can be
OWN_TARGETS = 4  # plants of the generator itself that are aimed at, besides the pictures
BUDGET = Budget(12_000, 24_000)  # that of a search for 3,000 vertices
LEAST_PIXELS = 0.002  # of height**2; a class with fewer has no ratio of its own in a plant

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Seen:
    """What a view makes of p plants: scores (t, p) against t targets by similarity, class pixels (p, 2) / height**2."""

    scores: dict[str, Floats]
    pixels: Floats


@dataclass(frozen=True)
class Agreement:
    """A view at `rows` rows against the reference: means over targets, and the least of them."""

    rows: int
    similarity: str
    spearman: float
    spearman_least: float
    best_half: float
    best_half_least: float
    spearman_limit: float  # the same for the naive view at `rows` rows: what the resolution alone costs
    best_half_limit: float
    branch_pixels: float  # by those of the reference, summed over all plants
    foliage_pixels: float
    branch_pixels_limit: float
    foliage_pixels_limit: float
    branch_pixels_mean: float  # mean of the ratios of single plants
    foliage_pixels_mean: float


def measure(
    generator: Generator,
    view: View,
    similarities: Mapping[str, Similarity[Any]],
    pictures: Sequence[Mask],
    plants: int,
    rows: Sequence[int],
    seed: int,
) -> list[Agreement]:
    """Agreement of `view` at each of `rows` for each of `similarities`, aiming at `pictures` and at own plants."""
    grown = random_plants(generator, seed)
    chosen = [next(grown) for _ in range(plants)]
    words = max([2, *(frame_for(mask, LEAST_ROWS).words for mask in pictures)])
    wide = Frame(LEAST_ROWS, words)
    finest = wide.finer(REFERENCE_ROWS)
    targets = [*pictures, *(zbuffer_mask(next(grown), finest) for _ in range(OWN_TARGETS))]
    reference = look(by_reference, finest, chosen, targets, similarities)
    found = []
    for height in rows:
        frame = wide.finer(height)
        seen, naive = (look(draw, frame, chosen, targets, similarities) for draw in (view, by_reference))
        found += [_agreement(height, name, seen, naive, reference) for name in similarities]
    return found


def random_plants(generator: Generator, seed: int) -> Iterator[Plant]:
    """Endless plants of random genomes that a search could score and an eye could see."""
    rng = np.random.default_rng(seed)
    while True:
        plant = generator(generator.space.decode(rng.random(len(generator.space))), seed, BUDGET)
        if plant.cut:
            continue
        check_plant(plant)
        if (zbuffer_mask(plant, Frame(LEAST_ROWS, 2)) > 0).mean() > LEAST_PIXELS:
            yield plant


def by_reference(plant: Plant, frame: Frame) -> BitMask:
    """Bit rows of the naive view."""
    return BitMask.pack(zbuffer_mask(plant, frame))


def look(
    draw: Callable[[Plant, Frame], BitMask],
    frame: Frame,
    plants: Sequence[Plant],
    targets: Sequence[Mask],
    similarities: Mapping[str, Similarity[Any]],
) -> Seen:
    """Scores and class pixels of `plants` as `draw` shows them in `frame`."""
    aims = [BitMask.pack(sample(target, frame)) for target in targets]
    described = {name: [one.describe(bits) for bits in aims] for name, one in similarities.items()}
    scores = {name: np.empty((len(targets), len(plants))) for name in similarities}
    pixels = np.empty((len(plants), 2))
    for i, plant in enumerate(plants):
        bits = draw(plant, frame)
        counts = np.bitwise_count(bits.branch).sum(), np.bitwise_count(bits.foliage).sum()
        pixels[i] = np.array(counts, dtype=np.float64) / frame.height**2
        for name, similarity in similarities.items():
            own = similarity.describe(bits)
            scores[name][:, i] = [similarity.compare(target, own) for target in described[name]]
    return Seen(scores, pixels)


def _agreement(rows: int, name: str, seen: Seen, naive: Seen, reference: Seen) -> Agreement:
    every, best = _correlations(seen.scores[name], reference.scores[name])
    every_limit, best_limit = _correlations(naive.scores[name], reference.scores[name])
    branch, foliage = _ratios(seen, reference)
    branch_limit, foliage_limit = _ratios(naive, reference)
    branch_mean, foliage_mean = (_mean_ratio(seen.pixels[:, c], reference.pixels[:, c]) for c in (0, 1))
    return Agreement(
        rows, name, float(every.mean()), float(every.min()), float(best.mean()), float(best.min()),
        float(every_limit.mean()), float(best_limit.mean()), branch, foliage, branch_limit, foliage_limit,
        branch_mean, foliage_mean,
    )  # fmt: skip


def _correlations(scores: Floats, truth: Floats) -> tuple[Floats, Floats]:
    """Spearman's correlation of scores (t, p) with the true ones for each target, over all and over the best half."""
    pairs = [(one, two, two >= np.median(two)) for one, two in zip(scores, truth, strict=True)]
    every = [_spearman(one, two) for one, two, _ in pairs]
    return np.array(every), np.array([_spearman(one[best], two[best]) for one, two, best in pairs])


def _ratios(seen: Seen, reference: Seen) -> tuple[float, float]:
    """Pixels of branches and of foliage by those of the reference, over all plants."""
    branch, foliage = seen.pixels.sum(axis=0) / reference.pixels.sum(axis=0)
    return float(branch), float(foliage)


def _spearman(one: Floats, two: Floats) -> float:
    return float(spearmanr(one, two).statistic)


def _mean_ratio(seen: Floats, truth: Floats) -> float:
    enough = truth >= LEAST_PIXELS
    return float((seen[enough] / truth[enough]).mean())
