"""What the tracking keeps of a fit beside its files: the tags to filter by, and the few settings to compare."""

from __future__ import annotations

from pathlib import Path
from typing import cast

from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from experiments.candidate_facts import metrics
from experiments.command_check import CONFIG_FOLDER
from experiments.read_tree import ReadTree
from experiments.settings import read_settings
from treefit.asset import MeshCounts
from treefit.candidates import Candidate
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.progress import Generation
from treefit.tracking import Tracker


def start_tracking(
    tracker: Tracker, cfg: DictConfig, tree: ReadTree, generator: Generator, folder: Path, parent: str | None
) -> None:
    """Begin the run of a fit, or go on with the one that `folder` is already."""
    name = f"{Path(tree.name).stem} by {generator.name}"  # lists are too narrow for that of the folder
    tracker.start(name, tags(cfg, tree, generator, folder), params(cfg, tree, generator), parent, folder)


def tags(cfg: DictConfig, tree: ReadTree, generator: Generator, folder: Path) -> dict[str, str]:
    """What runs are filtered by."""
    optimizer = nearest_option("optimizer", cfg.optimizer)
    return {"task": "fit", "image": tree.name, "generator": generator.name, "optimizer": optimizer,
            "generator_version": generator.version, "folder": folder.name}  # fmt: skip


def params(cfg: DictConfig, tree: ReadTree, generator: Generator) -> dict[str, str]:
    """The settings that runs are compared by, a dozen or so: each takes room from the pictures on mlflow's page."""
    settings = read_settings(cfg)
    wishes = cast(Characteristics, build(cfg.characteristics, "characteristics"))
    chosen = {
        "image": tree.name,
        "generator": generator.name,
        "optimizer": nearest_option("optimizer", cfg.optimizer),
        "similarity": nearest_option("similarity", cfg.similarity),
        "mask": tree.extraction.method,
        "seed": settings.seed,
        "evaluations": cfg.optimizer.get("evaluations"),
        "resolution": cfg.view.get("resolution"),
        "candidates": settings.candidates.count,
        "azimuths": _unless(cfg.view.get("azimuths"), 1),
        "objective_seeds": _unless(settings.objective.seeds, 1),
        "stop_score": settings.stop.score,
        "stop_seconds": settings.stop.seconds,
        "start": ", ".join(settings.start) or None,
        "memory": settings.memory.use or None,
    }
    wanted = {f"wanted_{name}": value for name, value in wishes.wanted.items()}
    return {name: str(value) for name, value in (chosen | wanted).items() if value is not None}


def standing(now: Generation) -> dict[str, float]:
    """Numbers of one generation; the score of the best, which runs are listed with, is known from the first one on."""
    return {
        "score": round(now.best, 4),
        "image_similarity": round(now.best_image, 4),
        "curves/best_score": now.best,
        "curves/mean_score": now.mean,
        "curves/failures": now.failures,
        "curves/evaluations_per_second": now.evaluations_per_second,
    }


def track_result(tracker: Tracker, best: Candidate, mesh: MeshCounts, evaluations: int) -> None:
    """Keep all numbers of the best candidate: as the end of its curve, or at step 0, drawn as a bar."""
    known = metrics(best, mesh)
    ends = {name: known.pop(name) for name in ("score", "image_similarity")}
    tracker.log(ends, evaluations)
    tracker.log(known, 0)


def _unless(value: object, usual: object) -> object:
    """Return `value`, or None where it is the `usual` one and not worth a line."""
    return None if value == usual else value


def nearest_option(group: str, node: DictConfig) -> str:
    """Name of the file in conf/<group> of the same kind that `node` has most settings in common with."""
    kind = str(node.get("_target_", group))
    given = OmegaConf.to_container(node, resolve=True)
    assert isinstance(given, dict)
    common: dict[str, int] = {}
    for file in sorted((CONFIG_FOLDER / group).glob("*.yaml")):
        option = OmegaConf.load(file)
        if isinstance(option, DictConfig) and option.get("_target_") == kind:
            common[file.stem] = sum(option.get(name) == value for name, value in node.items())
    return max(common, key=lambda name: common[name]) if common else kind.rpartition(".")[2]
