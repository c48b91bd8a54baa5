"""Task fit: a picture in, a few distinct trees out, with everything that was found written to the run's folder."""

from __future__ import annotations

from pathlib import Path
from typing import cast

from omegaconf import DictConfig

from experiments.beginning import remember, start_of
from experiments.build import build
from experiments.candidate_facts import metrics
from experiments.candidate_words import row
from experiments.errors import UserError
from experiments.read_tree import ReadTree, read_tree
from experiments.run_folder import run_folder
from experiments.run_log import RunLog
from experiments.settings import Candidates, read_settings
from experiments.summary import summary
from experiments.sweep_parent import parent_run
from experiments.terminal import Progress, print_results
from experiments.write_run import write_candidates, write_gallery, write_json, write_page, write_table
from treefit.asset import AssetSettings
from treefit.checkpoint import CheckpointError
from treefit.distinct import Distinct
from treefit.evaluation import Evaluator
from treefit.fit import Result, Stop, fit
from treefit.mask import Mask
from treefit.objective import View
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation
from treefit.racing import Seeds
from treefit.search import Strategy
from treefit.similarity import Similarity
from treefit.tracking import Tracker


def run(cfg: DictConfig) -> None:
    """Fit cfg.generator to cfg.image; SearchError when nothing could be scored."""
    folder = run_folder()
    tree = read_tree(cfg, folder)
    tracker = cast(Tracker, build(cfg.tracking, "tracking"))
    tracker.start(folder.name, _tags(cfg, tree), _params(cfg), parent_run())
    status = "FAILED"
    try:
        _fit_and_write(cfg, tree, tracker, folder)
        status = "FINISHED"
    except KeyboardInterrupt:
        status = "KILLED"
        raise
    finally:
        tracker.artifacts(folder)
        tracker.finish(status)


def _fit_and_write(cfg: DictConfig, tree: ReadTree, tracker: Tracker, folder: Path) -> None:
    generator = cast(Generator, build(cfg.generator, "generator"))
    asset = cast(AssetSettings, build(cfg.asset, "asset"))
    result = _fit(cfg, tree.extraction.mask, generator, tracker, folder)
    found = result.candidates
    remember(read_settings(cfg).memory, generator, tree.extraction.mask, found[0])
    meshes = write_candidates(folder, found, generator, asset)
    write_gallery(folder, tree, found, meshes, f"{tree.name} by {generator.name}")
    write_page(folder, tree, found, meshes)
    write_json(folder / "summary.json", summary(result, generator, tree, cfg.seed, meshes))
    write_table(folder / "candidates.csv", found, meshes)
    tracker.log(metrics(found[0], meshes[0]), result.evaluations)
    rows = [row(i + 1, *each) for i, each in enumerate(zip(found, meshes, strict=True))]
    print_results(rows, folder, tracker.where)


def _fit(cfg: DictConfig, mask: Mask, generator: Generator, tracker: Tracker, folder: Path) -> Result:
    settings = read_settings(cfg)
    strategy = cast(Strategy, build(cfg.optimizer, "optimizer"))
    log = RunLog(folder)
    with Progress() as progress:

        def on_generation(now: Generation, failures: list[Failure]) -> None:
            progress.update(now.evaluations, strategy.evaluations, now.best, now.evaluations_per_second)
            log.write(now, failures)
            tracker.log(
                {"best": now.best, "best_image": now.best_image, "mean": now.mean, "failures": now.failures,
                 "evaluations_per_second": now.evaluations_per_second}, now.evaluations,
            )  # fmt: skip

        try:
            return fit(
                mask, generator, similarity=cast(Similarity[object], build(cfg.similarity, "similarity")),
                characteristics=cast(Characteristics, build(cfg.characteristics, "characteristics")),
                view=cast(View, build(cfg.view, "view")), optimizer=strategy,
                evaluator=cast(Evaluator, build(cfg.evaluator, "evaluator")), seed=settings.seed,
                candidates=settings.candidates.count, distinct=_distinct(settings.candidates),
                runners_up=settings.candidates.runners_up,
                seeds=Seeds(settings.objective.seeds, settings.objective.racing),
                other_seeds=settings.other_seeds, stop=Stop(settings.stop.score, settings.stop.seconds),
                checkpoint=folder / "checkpoint.npz",
                start=start_of(settings.start, settings.memory, generator, mask, folder),
                on_generation=on_generation,
            )  # fmt: skip
        except CheckpointError as error:
            raise UserError(f"resume: {error}") from error


def _distinct(settings: Candidates) -> Distinct:
    return Distinct(settings.min_distance, settings.within)


def _tags(cfg: DictConfig, tree: ReadTree) -> dict[str, str]:
    kinds = {group: str(cfg[group].get("_target_", group)).rpartition(".")[2] for group in ("generator", "optimizer")}
    return {**kinds, "image": tree.name}


def _params(cfg: DictConfig) -> dict[str, str]:
    """The few settings that runs are compared by."""
    chosen = {"seed": cfg.seed, "evaluations": cfg.optimizer.get("evaluations"),
              "resolution": cfg.view.get("resolution"), "vertices": None}  # fmt: skip
    wishes = cast(Characteristics, build(cfg.characteristics, "characteristics"))
    return {name: str(value) for name, value in (chosen | wishes.wanted).items()}
