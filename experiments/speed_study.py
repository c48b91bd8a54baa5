"""Task speed_study: time by the size of the tree and of the picture, as a table (speed.md) and a plot (speed.png)."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import cast

import numpy as np
from omegaconf import DictConfig

from experiments.build import build
from experiments.numbers import rounded
from experiments.rival_views import Rival, rivals
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.sized_trees import trees_of
from experiments.speed_page import GENERATE, OURS, Point, page
from experiments.speed_plot import draw_speed
from experiments.timing import cpu_ms, wall_ms
from treefit.objective import View
from treefit.plant import Budget, Generator, Genome, Plant
from treefit.view import Frame

TREES, ROUNDS, FEW_ROUNDS = 3, 5, 1
PASSES = 3  # over everything: a busy minute of the machine must not fall on one point alone
LEAVES = 2  # for every vertex
ROWS, VERTICES = 128, 5_000  # what stays while the other one changes

Trees = tuple[list[Genome], list[Plant]]


def run(cfg: DictConfig) -> None:
    """Measure cfg.generator and cfg.view against other means; write speed.md, speed.json and speed.png."""
    generator = cast(Generator, build(cfg.generator, "generator"))
    view = cast(View, build(cfg.view, "view"))
    settings = read_settings(cfg)
    wanted = settings.speed_study
    sizes = sorted({*wanted.vertices, VERTICES})
    trees = dict(zip(sizes, _trees(generator, sizes, settings.seed), strict=True))
    asked = [(trees[size], ROWS) for size in sizes]
    asked += [(trees[VERTICES], rows) for rows in sorted({*wanted.rows, ROWS})]
    passes = [[measure(generator, view, *one, settings.seed) for one in asked] for _ in range(PASSES)]
    points = [_least(times) for times in zip(*passes, strict=True)]
    _write(generator.name, points[: len(sizes)], points[len(sizes) :], wanted.renew)


def measure(generator: Generator, view: View, trees: Trees, rows: int, seed: int) -> Point:
    """Times of growing `trees` and of drawing them at `rows` rows, by every means that this machine has."""
    genomes, plants = trees
    frame = Frame(rows, -(-2 * rows // 64))
    vertices, leaves = ([getattr(plant, name) for plant in plants] for name in ("n_vertices", "n_leaves"))
    budget = Budget(2 * max(vertices), 2 * max(leaves))
    ms = {
        OURS: cpu_ms(lambda plant: view(plant, frame), plants, ROUNDS),
        GENERATE: cpu_ms(lambda genome: generator(generator.space.decode(genome), seed, budget), genomes, ROUNDS),
    }
    ms |= {rival.title: _rival_ms(rival, plants, frame) for rival in rivals().values() if not rival.missing}
    return Point(round(float(np.mean(vertices))), round(float(np.mean(leaves))), rows, ms)


def _rival_ms(rival: Rival, plants: Sequence[Plant], frame: Frame) -> float:
    clock = wall_ms if rival.threads else cpu_ms
    return clock(lambda plant: rival.draw(plant, frame), plants, FEW_ROUNDS)


def _trees(generator: Generator, sizes: Sequence[int], seed: int) -> list[Trees]:
    """Genomes and plants for each of the `sizes`, with room for the largest."""
    budget = Budget(2 * max(sizes), 2 * LEAVES * max(sizes))
    found = trees_of(generator, [(size, LEAVES * size) for size in sizes], TREES, seed)
    return [(genomes, [generator(generator.space.decode(one), seed, budget) for one in genomes]) for genomes in found]


def _least(points: Sequence[Point]) -> Point:
    """The same point measured several times: of each time the least."""
    return replace(points[0], ms={name: min(point.ms[name] for point in points) for name in points[0].ms})


def _write(generator: str, by_size: Sequence[Point], by_rows: Sequence[Point], renew: bool) -> None:
    """Write the files, to the repository when they are to `renew` those there; print one JSON line last."""
    here = Path(__file__).parent
    table = (here if renew else run_folder()) / "speed.md"
    figure = (here / "figures" if renew else run_folder()) / "speed.png"
    how = f"mean of {TREES} trees, the least of {PASSES} passes"
    draw_speed(by_size, by_rows, figure)
    table.write_text(page(generator, by_size, by_rows, figure, how), encoding="utf-8")
    facts = {"by_size": [vars(point) for point in by_size], "by_rows": [vars(point) for point in by_rows]}
    (run_folder() / "speed.json").write_text(json.dumps(facts, indent=1), encoding="utf-8")
    for name, rival in rivals().items():
        if rival.missing:
            print(f"without {name}: {rival.missing}", file=sys.stderr)
    print(json.dumps(rounded({"table": str(table), "figure": str(figure), **facts})), flush=True)
