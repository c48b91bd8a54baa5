"""Task benchmark: how fast one evaluation is on one core, and the same view by other means in the same run."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
from omegaconf import DictConfig
from rich.console import Console
from rich.table import Table

from experiments.build import build
from experiments.numbers import rounded
from experiments.page_faults import faults_per_call
from experiments.plant_speed import plant_speed
from experiments.preset import wanted_plant
from experiments.rival_views import rivals
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.sized_trees import trees_of
from experiments.startup import first_evaluation_seconds
from experiments.timing import cpu_ms, in_turn
from treefit.evaluation import Evaluator
from treefit.fit import aim
from treefit.objective import Objective, View
from treefit.plant import Budget, Generator, Genome, Plant
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity, Similarity
from treefit.view import Frame

VERTICES, LEAVES = 5_000, 10_000  # of the trees that are measured
LARGE_VERTICES, LARGE_LEAVES, LARGE_TREES, LARGE_DRAWS = 100_000, 200_000, 2, 300
LARGE_BUDGET = Budget(2 * LARGE_VERTICES, 2 * LARGE_LEAVES)
TREES, FEW = 8, 2  # FEW: for views that take some tenths of a second
BATCHES, BATCH = 5, 320  # evaluations on one and on two threads

Facts = dict[str, object]


def run(cfg: DictConfig) -> None:
    """Measure cfg.generator, cfg.view and cfg.similarity; print a table on a terminal, and one JSON line last."""
    generator = cast(Generator, build(cfg.generator, "generator"))
    view = cast(View, build(cfg.view, "view"))
    similarity = cast(Similarity[Any], build(cfg.similarity, "similarity"))
    settings = read_settings(cfg)
    facts = measure(generator, view, similarity, settings.seed)
    if settings.preset is not None:
        values, seed, _ = wanted_plant(cfg, generator)
        facts["preset"] = {"name": settings.preset, **plant_speed(_aimed(generator, view, similarity, seed), [values])}
    if settings.benchmark.startup:
        facts["first_evaluation_seconds"] = first_evaluation_seconds(run_folder() / "config.yaml")
    console = Console()
    if console.is_terminal:
        console.print(_table(facts))
    print(json.dumps(rounded(facts)), flush=True)


def measure(generator: Generator, view: View, similarity: Similarity[Any], seed: int) -> Facts:
    """Medians over rounds of the mean over trees of about VERTICES and LEAVES, on one core but for the threads."""
    (genomes,) = trees_of(generator, [(VERTICES, LEAVES)], TREES, seed)
    frame, budget = Frame(view.resolution, 4), Budget()
    plants = [generator(generator.space.decode(genome), seed, budget) for genome in genomes]
    objective = aim(view(plants[0], frame).unpack(), generator, similarity, Characteristics(vertices=VERTICES), view,
                    seed, budget)  # fmt: skip
    vertices, leaves = (float(np.mean([getattr(p, name) for p in plants])) for name in ("n_vertices", "n_leaves"))
    evaluate_ms = cpu_ms(objective, genomes)
    return {
        "generator": generator.name,
        "vertices": round(vertices),
        "leaves": round(leaves),
        "evaluations_per_second": 1e3 / evaluate_ms,
        "ns_per_primitive": 1e6 * evaluate_ms / (vertices + leaves),
        "generate_ms": cpu_ms(lambda one: generator(generator.space.decode(one), seed, budget), genomes),
        "view_ms": cpu_ms(lambda plant: view(plant, frame), plants),
        **compare_us(similarity, view, plants, frame),
        "page_faults": faults_per_call(objective, genomes),
        "two_threads_ratio": _two_threads_ratio(objective, genomes),
        "azimuths_4_ratio": _azimuths_ratio(view, plants, frame),
        **_rival_ratios(view, plants, frame),
        "large": large(generator, view, similarity, seed),
    }


def large(generator: Generator, view: View, similarity: Similarity[Any], seed: int) -> Facts:
    """Speed of trees of some 100,000 vertices and twice as many leaves, as random genomes come nearest to it."""
    (genomes,) = trees_of(generator, [(LARGE_VERTICES, LARGE_LEAVES)], LARGE_TREES, seed, LARGE_DRAWS)
    objective = _aimed(generator, view, similarity, seed)
    return plant_speed(objective, [generator.space.decode(genome) for genome in genomes])


def _aimed(generator: Generator, view: View, similarity: Similarity[Any], seed: int) -> Objective:
    """Objective whose target is the generator's tree of the middle genome, with room for large plants."""
    frame, middle = Frame(view.resolution, 4), np.full(len(generator.space), 0.5)
    plant = generator(generator.space.decode(middle), seed, LARGE_BUDGET)
    return aim(view(plant, frame).unpack(), generator, similarity, Characteristics(), view, seed, LARGE_BUDGET)


def compare_us(similarity: Similarity[Any], view: View, plants: Sequence[Plant], frame: Frame) -> Facts:
    """Microseconds to describe a mask and compare it: of the similarity, of its terms and of the paper's."""
    masks = [view(plant, frame) for plant in plants]

    def us(one: Similarity[Any]) -> float:
        target = one.describe(masks[0])
        return 1e3 * cpu_ms(lambda mask: one.compare(target, one.describe(mask)), masks)

    found: Facts = {"compare_us": us(similarity), "paper_compare_us": us(PaperSimilarity())}
    terms = getattr(similarity, "terms", None)
    if isinstance(terms, Mapping):
        found["terms_compare_us"] = {str(name): us(term) for name, term in terms.items()}
    return found


def _two_threads_ratio(objective: Objective, genomes: Sequence[Genome]) -> float:
    """Evaluations a second of two threads by those of one, on the clock: the best of some batches each."""
    batch = np.array([genomes[i % len(genomes)] for i in range(BATCH)])
    best: dict[int, float] = {}
    for _ in range(BATCHES):
        for workers in (1, 2):
            started = time.perf_counter()
            Evaluator(kind="threads", workers=workers)(objective, batch)
            best[workers] = min(time.perf_counter() - started, best.get(workers, math.inf))
    return best[1] / best[2]


def _azimuths_ratio(view: View, plants: Sequence[Plant], frame: Frame) -> float | None:
    """Time to see a plant from four sides by that from one; None for a view that has one side."""
    if not hasattr(view, "azimuths"):
        return None
    views = {sides: replace(cast(Any, view), azimuths=sides) for sides in (1, 4)}
    calls = {str(sides): (lambda plant, view=view: view.sides(plant, frame)) for sides, view in views.items()}
    taken = in_turn(calls, plants)
    return taken["4"] / taken["1"]


def _rival_ratios(view: View, plants: Sequence[Plant], frame: Frame) -> dict[str, float | None]:
    """Time of the same masks by other means over that of `view`; None for those that this machine has not."""
    found: dict[str, float | None] = {}
    for name, rival in rivals().items():
        if rival.missing:
            found[f"{name}_ratio"] = None
            continue
        calls = {name: (lambda plant, draw=draw: draw(plant, frame)) for name, draw in
                 {"ours": view, "rival": rival.draw}.items()}  # fmt: skip
        taken = in_turn(calls, plants[:FEW], 3, time.perf_counter) if rival.threads else in_turn(calls, plants, 5)
        found[f"{name}_ratio"] = taken["rival"] / taken["ours"]
    return found


def _table(facts: Mapping[str, object]) -> Table:
    table = Table(box=None, pad_edge=False, show_header=False)
    for name, value in facts.items():
        parts = value if isinstance(value, Mapping) else {"": value}
        for part, number in parts.items():
            shown = f"{rounded(number):,}" if isinstance(number, float | int) else str(number or "-")
            table.add_row(f"{name.replace('_', ' ')} {part}".strip(), shown)
    return table
