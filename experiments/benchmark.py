"""Task benchmark: how fast one evaluation is on one core, and the same view by other means in the same run."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from statistics import median
from typing import Any, cast

import numpy as np
from omegaconf import DictConfig

from experiments.build import build
from experiments.opencv_view import opencv_mask, opencv_missing
from treefit.fit import aim
from treefit.objective import View
from treefit.plant import Budget, Generator, Genome, Plant
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity
from treefit.view import Frame, OrthographicView
from treefit.view.gl import gl_mask, gl_missing

VERTICES, LEAVES = 5_000, 10_000  # of the trees that are measured
DRAWS, TREES, ROUNDS = 3_000, 8, 7


def run(cfg: DictConfig) -> None:
    """Measure cfg.generator, cfg.view and cfg.similarity; print one JSON line."""
    generator = cast(Generator, build(cfg.generator, "generator"))
    view = cast(View, build(cfg.view, "view"))
    similarity = cast(Similarity[Any], build(cfg.similarity, "similarity"))
    print(json.dumps(measure(generator, view, similarity, int(cfg.seed))), flush=True)


def measure(generator: Generator, view: View, similarity: Similarity[Any], seed: int) -> dict[str, object]:
    """Medians over rounds of the mean over trees of about VERTICES and LEAVES, all on one core."""
    genomes = _genomes(generator, seed)
    values = [generator.space.decode(genome) for genome in genomes]
    budget = Budget()
    plants = [generator(chosen, seed, budget) for chosen in values]
    frame = Frame(view.resolution, 4)
    mask = view(plants[0], frame).unpack()
    objective = aim(mask, generator, similarity, Characteristics(vertices=VERTICES), view, seed, budget)
    described = [similarity.describe(view(plant, frame)) for plant in plants]
    target = similarity.describe(view(plants[0], frame))
    masks = [view(plant, frame) for plant in plants]
    primitives = float(np.mean([plant.n_vertices + plant.n_leaves for plant in plants]))
    evaluate_ms = _ms(objective, genomes)
    view_ms = _ms(lambda plant: view(plant, frame), plants)
    compare_ms = _ms(similarity.describe, masks) + _ms(lambda one: similarity.compare(target, one), described)
    return {
        "generator": generator.name,
        "vertices": round(np.mean([plant.n_vertices for plant in plants])),
        "leaves": round(np.mean([plant.n_leaves for plant in plants])),
        "evaluations_per_second": 1e3 / evaluate_ms,
        "generate_ms": _ms(lambda chosen: generator(chosen, seed, budget), values),
        "view_ms": view_ms,
        "compare_us": 1e3 * compare_ms,
        "ns_per_primitive": 1e6 * evaluate_ms / primitives,
        **_ratios(plants, frame),
    }


def _genomes(generator: Generator, seed: int) -> list[Genome]:
    """Random genomes whose plants are nearest to the wanted counts."""
    rng = np.random.default_rng(seed)
    drawn = rng.random((DRAWS, len(generator.space)))
    budget = Budget(2 * VERTICES, 2 * LEAVES)
    away = [_away(generator(generator.space.decode(genome), seed, budget)) for genome in drawn]
    return [drawn[i] for i in np.argsort(away, kind="stable")[:TREES]]


def _away(plant: Plant) -> float:
    return abs(math.log(plant.n_vertices / VERTICES)) + abs(math.log((plant.n_leaves + 1) / LEAVES))


def _ms(call: Callable[[Any], object], arguments: list[Any]) -> float:
    """Milliseconds a call of this thread's processor time: median over rounds of the mean over `arguments`."""
    rounds = []
    for _ in range(ROUNDS + 1):
        started = time.thread_time()
        for argument in arguments:
            call(argument)
        rounds.append((time.thread_time() - started) / len(arguments) * 1e3)
    return median(rounds[1:])


def _ratios(plants: list[Plant], frame: Frame) -> dict[str, float | None]:
    """Time of the same masks by pyrender and by OpenCV polygons, over that of the bit-row rasteriser."""
    fast = OrthographicView()
    ours = _ms(lambda plant: fast(plant, frame), plants)
    few = plants[:2]
    by_gl = None if gl_missing() else _process_ms(lambda plant: gl_mask(plant, frame.height, frame.half_width), few)
    by_opencv = None if opencv_missing() else _ms(lambda plant: opencv_mask(plant, frame), few)
    return {
        "pyrender_ratio": None if by_gl is None else by_gl / ours,
        "opencv_ratio": None if by_opencv is None else by_opencv / ours,
    }


def _process_ms(call: Callable[[Any], object], arguments: list[Any]) -> float:
    """As _ms, in time on the clock: the graphics library works on threads of its own."""
    rounds = []
    for _ in range(3):
        started = time.perf_counter()
        for argument in arguments:
            call(argument)
        rounds.append((time.perf_counter() - started) / len(arguments) * 1e3)
    return median(rounds[1:])
