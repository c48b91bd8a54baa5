"""Task fit: a picture in, a few distinct trees out, with everything that was found written to the run's folder."""

from __future__ import annotations

from pathlib import Path
from typing import cast

from omegaconf import DictConfig

from experiments.beginning import remember, start_of
from experiments.build import build
from experiments.candidate_words import row
from experiments.dressing import suited
from experiments.errors import UserError
from experiments.live import Live, NoLive
from experiments.live_page import PAGE
from experiments.read_tree import ReadTree, read_tree
from experiments.run_folder import run_folder
from experiments.run_log import RunLog
from experiments.run_story import failure_story, fit_story
from experiments.search_stages import stage_name
from experiments.search_story import write_search_story
from experiments.settings import Candidates, read_settings
from experiments.summary import summary
from experiments.sweep_parent import parent_run
from experiments.terminal import Progress, patience, print_live, print_results
from experiments.tracked import standing, start_tracking, track_result
from experiments.viewer_page import write_page
from experiments.where_to_browse import where_to_browse
from experiments.write_run import write_candidates, write_json, write_sheets, write_table
from treefit.asset import AssetSettings, Level, check_possible
from treefit.checkpoint import CheckpointError
from treefit.distinct import Distinct
from treefit.evaluation import Evaluator
from treefit.fit import Result, fit
from treefit.mask import Mask
from treefit.objective import View
from treefit.plant import Generator
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation
from treefit.racing import Seeds
from treefit.search import Strategy
from treefit.similarity import Similarity
from treefit.stop import Stop
from treefit.tracking import Tracker


def run(cfg: DictConfig) -> None:
    """Fit cfg.generator to cfg.image; SearchError when nothing could be scored."""
    folder = run_folder()
    tree = read_tree(cfg, folder)
    cfg = suited(cfg, tree)
    generator = cast(Generator, build(cfg.generator, "generator"))
    tracker = cast(Tracker, build(cfg.tracking, "tracking"))
    start_tracking(tracker, cfg, tree, generator, folder, parent_run())
    status = "FAILED"
    try:
        with _live(cfg, tree, generator, folder) as live:
            _fit_and_write(cfg, tree, generator, tracker, folder, live)
        status = "FINISHED"
    except KeyboardInterrupt:
        status = "KILLED"
        raise
    except Exception as error:
        tracker.tell(failure_story(tree, generator.name, error))
        raise
    finally:
        tracker.artifacts(folder)
        tracker.finish(status)


def _live(cfg: DictConfig, tree: ReadTree, generator: Generator, folder: Path) -> NoLive:
    """Page that shows the search while it goes on, when it is wanted."""
    if not read_settings(cfg).live:
        return NoLive()
    asset = cast(AssetSettings, build(cfg.asset, "asset"))
    print_live(folder / PAGE)
    return Live(folder, tree, f"{tree.name} by {generator.name}", int(cfg.optimizer.evaluations), asset)


def _fit_and_write(
    cfg: DictConfig, tree: ReadTree, generator: Generator, tracker: Tracker, folder: Path, live: NoLive
) -> None:
    asset = cast(AssetSettings, build(cfg.asset, "asset"))
    check_possible(asset)
    result = _fit(cfg, tree.extraction.mask, generator, tracker, folder, live)
    live.searched()
    found = result.candidates
    remember(read_settings(cfg).memory, generator, tree.extraction.mask, found[0])
    with patience("writing the trees and their pictures; the first time this compiles kernels too, some 25 s"):
        files = write_candidates(folder, found, generator, asset, tree.colours)
    meshes = [each.counts for each in files]
    write_sheets(folder, tree, found, meshes, f"{tree.name} by {generator.name}")
    write_search_story(folder, result, tree, asset, f"{tree.name} by {generator.name}")
    levels = [[Level(level.triangles, level.silhouette_iou) for level in each.levels] for each in files]
    write_page(folder, tree, found, meshes, generator.space, levels)
    write_json(folder / "summary.json", summary(result, generator, tree, cfg.seed, files))
    write_table(folder / "candidates.csv", found, files)
    track_result(tracker, found[0], meshes[0], result.evaluations)
    tracker.tell(fit_story(folder, tree, found, meshes, generator.name))
    rows = [row(i + 1, *each) for i, each in enumerate(zip(found, meshes, strict=True))]
    print_results(rows, folder, where_to_browse(cfg.tracking, tracker))


def _fit(cfg: DictConfig, mask: Mask, generator: Generator, tracker: Tracker, folder: Path, live: NoLive) -> Result:
    settings = read_settings(cfg)
    strategy = cast(Strategy, build(cfg.optimizer, "optimizer"))
    log = RunLog(folder)
    with Progress() as progress:

        def on_generation(now: Generation, failures: list[Failure]) -> None:
            progress.update(now.evaluations, strategy.evaluations, now.best, now.evaluations_per_second,
                            stage_name(now.stage))  # fmt: skip
            log.write(now, failures)
            live.on_generation(now)
            tracker.log(standing(now), now.evaluations)

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
                on_generation=on_generation, on_improvement=live.on_improvement, on_left_out=log.left_out,
            )  # fmt: skip
        except CheckpointError as error:
            raise UserError(f"resume: {error}") from error


def _distinct(settings: Candidates) -> Distinct:
    return Distinct(settings.min_distance, settings.within)
