"""Task adapt: the parameters of a foreign generator get ranges, tried on random trees, in a space file for searches."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from pathlib import Path
from typing import cast

from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig, OmegaConf

from experiments.adapting.beginning import Beginning, Foreign, beginning
from experiments.adapting.effects import effects
from experiments.adapting.ends import failing_ends
from experiments.adapting.findings import Findings, as_facts, size_parameter
from experiments.adapting.report import print_findings
from experiments.adapting.rounds import ROUNDS, try_rounds, try_space
from experiments.adapting.settings import Adapt
from experiments.adapting.sheet import plants_sheet
from experiments.adapting.space import as_space, judged
from experiments.adapting.trial import same_again
from experiments.adapting.yaml import space_text
from experiments.build import build
from experiments.command_line import quote
from experiments.errors import UserError
from experiments.numbers import rounded
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.write_run import write_json
from treefit.asset import AssetSettings
from treefit.plant import Value

REPEATED = 5
"""Trees that grow again, to see whether they are the same."""

DIGITS = 6  # of the numbers in adapt.json
UNSAFE = set(" ,:=[]{}()'\"$\\")  # what Hydra would read otherwise


def run(cfg: DictConfig) -> None:
    """Write space.yaml, plants.png and adapt.json for cfg.generator; print what was found, and the next command."""
    settings, folder = read_settings(cfg), run_folder()
    generator = build(cfg.generator, "generator")
    if not isinstance(generator, Foreign):
        raise UserError("generator: task=adapt is for foreign ones: generator=external 'generator.command=[...]'")
    asset = cast(AssetSettings, build(cfg.asset, "asset"))
    try:
        found = adapt(generator, _beginning(cfg.generator, generator, settings.adapt), settings.adapt, settings.seed)
        title = f"{found.generator}: {len(found.trial.good)} of {len(found.trial.trees)} random trees grew"
        again = generator.with_space(as_space(found.proposals))
        sheet = plants_sheet(again, found.trial.trees[: settings.adapt.shown], asset, title)
    finally:
        getattr(generator, "close", lambda: None)()
    files = {"space": folder / "space.yaml", "plants": folder / "plants.png", "facts": folder / "adapt.json"}
    more = {"space": str(shown(files["space"])), "size_parameter": size_parameter(found.proposals)}
    command = next_command({name: value for name, value in more.items() if value and name in cfg.generator})
    files["space"].write_text(space_text(found, command), encoding="utf-8")
    sheet.save(files["plants"])
    write_json(files["facts"], cast(dict[str, object], rounded({**as_facts(found), "next": command}, DIGITS)))
    print_findings(found, {name: shown(file) for name, file in files.items()}, command)


def _beginning(node: DictConfig, generator: Foreign, settings: Adapt) -> Beginning:
    fixed = cast(Mapping[str, Value], OmegaConf.to_container(node.fixed) if node.get("fixed") else {})
    own_space = "space" not in node or node.space is not None  # an adapter has always one
    return beginning(generator, settings, own_space, fixed)


def adapt(foreign: Foreign, start: Beginning, settings: Adapt, seed: int) -> Findings:
    """Findings on a foreign generator that begins with the proposals of `start`."""
    tried = try_rounds(foreign, start.proposals, settings.plants, seed, 1 if start.kept else ROUNDS)
    good = tried.trial.good
    bases = [tried.example, *good] if tried.example.grew else good
    does = effects(tried.generator, tried.generator.space, bases[: settings.moved])
    proposals = judged(tried.proposals, does, settings.threshold)
    if not any(one.searched for one in proposals):
        raise UserError(f"generator: no parameter changes {settings.threshold:.0%} of the picture of its trees")
    trial, generator = tried.trial, foreign.with_space(as_space(proposals))
    ends = failing_ends(trial)
    if len(generator.space) < len(trial.space):  # what is told of trees shall be true of the space that is written
        trial = try_space(generator, settings.plants, seed, tried.example)
        ends |= failing_ends(trial)
    return Findings(
        generator.name, generator.version, start.source, start.notes, proposals, tried.example, trial, tried.before,
        does, ends, same_again(generator, good[:REPEATED]),
    )  # fmt: skip


def next_command(more: Mapping[str, str]) -> str:
    """Command that fits a picture with the settings of the running one, and `more` ones of the generator."""
    given = [str(one) for one in HydraConfig.get().overrides.task]
    dropped = ("task=", "adapt.", "seed=", *(f"generator.{name}=" for name in more))
    kept = [one for one in given if not one.lstrip("+").startswith(dropped)]
    kept = [one.removeprefix("++") if one.startswith("++generator.fixed") else one for one in kept]
    added = [f"generator.{name}={quote(value) if set(value) & UNSAFE else value}" for name, value in more.items()]
    return f"python run.py {shlex.join([*kept, *added, 'image=pine.png'])}"


def shown(path: Path) -> Path:
    """`path` from where the user stands, if it is below."""
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path
