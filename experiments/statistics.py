"""Task statistics: what holds for all searches with a generator (sec. 5), counted beforehand."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from omegaconf import DictConfig, OmegaConf
from PIL import Image
from threadpoolctl import threadpool_limits

from experiments.build import build
from experiments.errors import UserError
from experiments.numbers import rounded
from experiments.option_names import option_name
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.statistics_collect import Collection
from experiments.statistics_plots import draw_calibration, draw_marks, draw_rate
from experiments.statistics_targets import Target, picture, targets
from experiments.terminal import counted
from treefit.evaluation import Evaluator
from treefit.family.batch import Batch, genes
from treefit.family.calibration import Calibration, calibrate
from treefit.family.collect import digest_of, statistics_of, thresholds
from treefit.family.guess import Guess, learn_guess
from treefit.family.identity import fingerprint
from treefit.family.members import Members
from treefit.family.network import Training
from treefit.family.statistics import Mark, Statistics
from treefit.objective import View
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.similarity import Similarity

MARKS: tuple[Mark, ...] = ("continuous", "paper")
FIGURES = Path(__file__).parent / "figures"
COLOURS = np.array([[255, 255, 255], [110, 70, 30], [70, 150, 60]], np.uint8)


def run(cfg: DictConfig) -> None:
    """Count for cfg.generator and cfg.similarity; files of the run folder make a killed run go on."""
    started, folder, settings = time.perf_counter(), run_folder(), read_settings(cfg)
    wanted, seed = settings.statistics, settings.seed
    generator = cast(Generator, build(cfg.generator, "generator"))
    if wanted.renew and generator.family is None:
        raise UserError(f"statistics.renew: generator {generator.name!r} has no folder for statistics of its own")
    aims = targets(wanted.targets, seed)
    Image.fromarray(COLOURS[picture(aims)]).save(folder / "targets.png", optimize=True)
    evaluator = cast(Evaluator, build(cfg.evaluator, "evaluator"))
    members = _members(cfg, generator, aims)
    collection = Collection(members, folder, digest_of(members, [aim.mask for aim in aims], seed), seed,
                            evaluator.workers, evaluator.backend(members))  # fmt: skip
    batches = collection.plants("pairs", wanted.plants, 0)
    eps = thresholds(batches, wanted.share, wanted.eps)
    moved = collection.moves(batches, eps, wanted.steps)
    found = statistics_of(members, batches, eps, wanted.parts, moved)
    fresh = collection.plants("pairs_fresh", wanted.fresh, 1)
    judged = {mark: calibrate(found, fresh, mark) for mark in MARKS}
    guess = _guess(members, batches, seed)
    files = _write(found, judged, folder, folder, "statistics", "statistics")
    guess.write(folder / "guess.npz")
    if wanted.renew and generator.family is not None:
        option = _part("generator", cfg.generator, generator.name)
        likeness = _part("similarity", cfg.similarity, "treefit")
        figure = f"statistics{option or '_' + generator.name}{likeness}"
        files += _write(found, judged, generator.family, FIGURES, f"statistics{option}{likeness}", figure)
        guess.write(generator.family / f"guess{option}.npz")
    facts = {**_facts(found, judged, time.perf_counter() - started), "guess_missed": round(guess.missed, 4)}
    (folder / "statistics.json").write_text(json.dumps(facts, indent=1), encoding="utf-8")
    print(json.dumps({"files": [str(file) for file in files], **facts}), flush=True)


def _members(cfg: DictConfig, generator: Generator, aims: Sequence[Target]) -> Members:
    view, similarity = cast(View, build(cfg.view, "view")), cast(Similarity[Any], build(cfg.similarity, "similarity"))
    wish = cast(Characteristics, build(cfg.characteristics, "characteristics"))
    wishes = [wish if wish.vertices is None else replace(wish, vertices=aim.vertices) for aim in aims]
    return Members.of([aim.mask for aim in aims], wishes, generator, view, similarity)


def _guess(members: Members, batches: Sequence[Batch], seed: int) -> Guess:
    """Guess learnt from the usable plants of `batches`; with one thread, so that its bytes are the same again."""
    training = Training()
    genomes, looks, vertices = (np.concatenate(each) for each in zip(*map(_pairs, batches), strict=True))
    epochs = counted(range(training.epochs), "epochs of learning to guess")
    with threadpool_limits(1, "blas"):
        return learn_guess(members.generator, members.space, genomes, looks, vertices, seed, training, epochs)


def _pairs(batch: Batch) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Genomes, features and counts of vertices of the usable plants of a batch."""
    kept = batch.usable
    return genes(batch.genomes[kept]), batch.features[kept], batch.vertices[kept]


def _write(
    found: Statistics, judged: Mapping[Mark, Calibration], folder: Path, figures: Path, name: str, figure: str
) -> list[Path]:
    """Write the statistics to `folder` and their plots to `figures`; return the files."""
    files = [folder / f"{name}.npz", *(figures / f"{figure}_{kind}.png" for kind in ("rate", "marks", "calibration"))]
    found.write(files[0])
    draw_rate(found, files[1])
    draw_marks(found, files[2])
    draw_calibration(found, judged, files[3])
    return files


def _part(group: str, node: DictConfig, usual: str) -> str:
    """Part of a file's name: that of the option, "" for the `usual` one, a hash for settings that no option has."""
    name = option_name(group, node) or fingerprint(OmegaConf.to_container(node, resolve=True))
    return "" if name == usual else f"_{name}"


def _facts(found: Statistics, judged: Mapping[Mark, Calibration], seconds: float) -> dict[str, object]:
    liveliest = np.argsort(-found.rate)[:5]
    calibration = {
        mark: {
            "rank_correlation": one.rank_correlation,
            "area": one.area,
            "lift_1": one.lift(0.01),
            "lift_10": one.lift(0.1),
        }
        for mark, one in judged.items()
    }
    facts = {
        "generator": found.generator, "version": found.version, "evaluations": found.evaluations, "p0": found.p0,
        "eps": [float(found.eps.min()), float(np.median(found.eps)), float(found.eps.max())],
        "liveliest": {found.names[i]: float(found.rate[i]) for i in liveliest}, "calibration": calibration,
        "seconds": seconds,
    }  # fmt: skip
    return cast(dict[str, object], rounded(facts, 4))
