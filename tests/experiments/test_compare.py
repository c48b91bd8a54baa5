"""The task compare: optimisers on the same targets, small."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hydra import compose, initialize_config_dir
from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig, open_dict

from experiments import compare
from experiments.command_check import CONFIG_FOLDER
from experiments.command_line import prepare
from experiments.compare_options import strategies
from experiments.compare_plan import plan
from experiments.compare_runs import Failed, Job, Run, attempt
from experiments.errors import UserError
from experiments.settings import read_settings
from tests.conftest import blob
from tests.search.settings import cma_es
from treefit.image import write_mask
from treefit.search import RandomSearch

SMALL = ["task=compare", "compare.optimizers=[random,tree_ga]", "compare.evaluations=150", "compare.budgets=[50,100]",
         "compare.hidden=1", "compare.repeats=1", "compare.workers=1", "other_seeds=1", "characteristics.vertices=400",
         "view.resolution=64", "tracking=none"]  # fmt: skip


@pytest.fixture
def masks(tmp_path: Path) -> str:
    write_mask(blob(64, 64), tmp_path / "mask_round.png")
    return str(tmp_path / "mask_*.png")


def settings(*lines: str, folder: Path | None = None) -> DictConfig:
    """Configuration of a run, in `folder` when one is given."""
    with initialize_config_dir(str(CONFIG_FOLDER), version_base="1.3"):
        overrides = prepare([*SMALL, *lines])
        cfg = compose("config", overrides=overrides, return_hydra_config=folder is not None)
    if folder is not None:
        with open_dict(cfg):
            cfg.hydra.runtime.output_dir = cfg.hydra.run.dir = str(folder)
        HydraConfig.instance().set_config(cfg)
    return cfg


def test_a_study_goes_on_where_it_was_stopped_and_takes_in_more_optimizers(
    tmp_path: Path, masks: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    compare.run(settings(f"compare.masks={masks}", folder=out))
    told = capsys.readouterr()
    assert json.loads(told.out) == {"table": str(out / "compare.md"), "runs": 4, "failed": 0}
    assert [line.partition(":")[0] for line in told.err.splitlines()] == [
        "0 of 4 searches are kept",
        "1/4 simplegen, round, random, repeat 1", "2/4 simplegen, round, tree_ga, repeat 1",
        "3/4 simplegen, hidden_1, random, repeat 1", "4/4 simplegen, hidden_1, tree_ga, repeat 1",
    ]  # fmt: skip
    text, facts = (out / "compare.md").read_text(encoding="utf-8"), json.loads((out / "compare.json").read_bytes())
    assert f"{tmp_path}" not in text
    assert "| optimizer | 50 | 100 | 150 |" in text
    assert {file.name for file in out.glob("*.png")} == {"compare_behind.png", "compare_curves.png"}

    (out / "runs" / "simplegen" / "round" / "tree_ga_1.json").unlink()
    more = ["compare.optimizers=[random,tree_ga,small]", "compare.variants={small: {base: cma_es, min_population: 8}}"]
    compare.run(settings(f"compare.masks={masks}", *more, folder=out))
    again = [line.partition(":")[0] for line in capsys.readouterr().err.splitlines()]
    assert again == [
        "3 of 6 searches are kept",
        "4/6 simplegen, round, tree_ga, repeat 1", "5/6 simplegen, round, small, repeat 1",
        "6/6 simplegen, hidden_1, small, repeat 1",
    ]  # fmt: skip
    new = json.loads((out / "compare.json").read_bytes())["simplegen"]["optimizers"]
    for name, numbers in facts["simplegen"]["optimizers"].items():
        assert new[name]["to_first"] == numbers["to_first"]
        assert new[name]["reach_quartiles"] == numbers["reach_quartiles"]


def test_a_search_that_fails_is_told_and_the_rest_goes_on(
    tmp_path: Path, masks: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def attempted(job: Job) -> Run | Failed:
        return attempt(job) if job.label.target == "round" else Failed(job.label, "ValueError: no tree today")

    monkeypatch.setattr(compare, "attempt", attempted)
    compare.run(settings(f"compare.masks={masks}", folder=tmp_path))
    told = capsys.readouterr()
    assert json.loads(told.out)["failed"] == 2
    assert "4/4 simplegen, hidden_1, tree_ga, repeat 1: failed: ValueError: no tree today" in told.err
    assert "1 targets, 1 searches" in (tmp_path / "compare.md").read_text(encoding="utf-8")


def test_all_optimizers_keep_abreast_and_repeats_have_seeds_of_their_own(masks: str) -> None:
    cfg = settings(f"compare.masks={masks}", "compare.repeats=2", "compare.generators=[simplegen,weberpenn]",
                   "compare.baselines=[cma_es]", "seed=5", "characteristics=none")  # fmt: skip
    study, jobs = plan(cfg, read_settings(cfg))
    assert study.planned == len(jobs) == 2 * 2 * 5
    first = [(job.label.generator, job.label.target, job.label.optimizer) for job in jobs[:6]]
    assert first == [
        ("simplegen", "round", "random"), ("simplegen", "round", "tree_ga"), ("simplegen", "round", "cma_es"),
        ("weberpenn", "round", "random"), ("weberpenn", "round", "tree_ga"), ("simplegen", "hidden_1", "random"),
    ]  # fmt: skip
    assert {(job.label.repeat, job.seed) for job in jobs} == {(0, 5), (1, 6)}
    assert len({job.settings for job in jobs}) == len(jobs)
    again = plan(cfg, read_settings(cfg))[1]
    assert [job.settings for job in again] == [job.settings for job in jobs]


def test_a_variant_is_its_base_with_other_settings() -> None:
    line = "compare.variants={wide: {base: cma_es, step: 0.4}}"
    wanted = read_settings(settings("compare.optimizers=[wide,random]", line)).compare
    assert strategies(wanted) == {"wide": cma_es(evaluations=150, step=0.4), "random": RandomSearch(evaluations=150)}


@pytest.mark.parametrize(
    ("lines", "message"),
    [(["compare.optimizers=[cma_ess]"], r"compare\.optimizers: no optimizer 'cma_ess'; did you mean 'cma_es'"),
     (["compare.baselines=[cma_ess]"], r"compare\.baselines: no optimizer 'cma_ess'; did you mean 'cma_es'"),
     (["compare.reference=[tree_gaa]"], r"compare\.reference: no optimizer 'tree_gaa'; did you mean 'tree_ga'"),
     (["compare.generators=[simple]"], r"compare\.generators: no generator 'simple'; did you mean"),
     (["compare.optimizers=[a]", "compare.variants={a: {step: 0.4}}"], r"compare\.variants\.a: needs a base"),
     (["compare.optimizers=[a]", "compare.variants={a: {base: cma_es, stp: 0.4}}"],
      r"compare\.variants\.a\.stp: no such setting; did you mean 'step'"),
     (["compare.masks=none_*.png"], r"compare\.masks: no file matches"),
     (["compare.evaluations=0"], r"compare\.evaluations: must be greater"),
     (["compare.optimizers=['../x']"], r"compare\.optimizers")],
)  # fmt: skip
def test_wrong_settings_are_one_line(lines: list[str], message: str, masks: str) -> None:
    cfg = settings(*([] if "masks" in lines[0] else [f"compare.masks={masks}"]), *lines)
    with pytest.raises(UserError, match=message):
        _planned(cfg)


def _planned(cfg: DictConfig) -> None:
    plan(cfg, read_settings(cfg))
