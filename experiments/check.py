"""Task check: does a generator keep the rules of the contract; a table, check.json, and plants that break rules."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import cast

from omegaconf import DictConfig
from rich.console import Console
from rich.table import Table
from rich.text import Text

from experiments.build import build
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.terminal import counted
from treefit.plant import Generator, write_preset
from treefit.plant.contract import RULES, Finding, draw_sample, try_rule

WIDE = 200
"""Columns of the table where no terminal says how many there are."""

STYLES = {"ok": "green", "warning": "yellow", "failed": "bold red", "not tried": "dim"}


class ContractBroken(RuntimeError):  # noqa: N818  it is the generator that is wrong
    """A generator breaks rules that must hold: no input error, for the program has done what it was asked."""


def run(cfg: DictConfig) -> None:
    """Try all rules on cfg.generator and tell what was found; ContractBroken when one is broken that must hold."""
    generator = cast(Generator, build(cfg.generator, "generator"))
    settings = read_settings(cfg)
    wanted = settings.check
    sample = draw_sample(generator, wanted.plants, few=wanted.again, seed=settings.seed,
                         shown=lambda genomes: counted(genomes, "random plants"))  # fmt: skip
    findings = [try_rule(rule, sample) for rule in counted(RULES, "rules")]
    folder = run_folder()
    _write(findings, generator, len(sample.attempts), folder)
    _show(findings, folder)
    if broken := [one.rule for one in findings if one.verdict == "failed"]:
        rules = f"{len(broken)} of {len(findings)} rules" if len(broken) > 1 else "a rule"
        raise ContractBroken(f"{generator.name} breaks {rules}: {', '.join(broken)}")


def _write(findings: Sequence[Finding], generator: Generator, plants: int, folder: Path) -> None:
    """Write check.json, and a preset of each plant that breaks a rule."""
    facts = {
        "generator": str(generator.name), "version": str(generator.version), "plants": plants,
        "rules": [asdict(finding) for finding in findings],
    }  # fmt: skip
    (folder / "check.json").write_text(json.dumps(facts, indent=1, default=str), encoding="utf-8")
    for finding in findings:
        if finding.values is not None:
            write_preset(
                folder / f"{finding.rule.replace(' ', '_')}.yaml", generator=generator.name, version=generator.version,
                seed=finding.seed, values=finding.values, notes={"check": finding.message},
            )  # fmt: skip


def _show(findings: Sequence[Finding], folder: Path) -> None:
    """Print a line a rule, and how many of them hold."""
    console = Console()
    if not console.is_terminal:
        console = Console(width=WIDE)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold", max_width=52)
    table.add_column(overflow="fold", ratio=1)
    for finding in findings:
        word = finding.verdict.upper() if finding.verdict == "failed" else finding.verdict
        table.add_row(Text(word, STYLES[finding.verdict]), finding.rule, Text(finding.message))
    console.print(table)
    counts = [f"{count} {verdict}" for verdict in ("warning", "failed", "not tried")
              if (count := sum(one.verdict == verdict for one in findings))]  # fmt: skip
    held = f"{sum(one.verdict == 'ok' for one in findings)} of {len(findings)} rules hold"
    lines = [f"check    {', '.join([held, *counts])}", f"results  {folder}"]
    if any(finding.values is not None for finding in findings):
        lines.append("look     python run.py task=grow preset=<a yaml of that folder>, with the same generator")
    for line in lines:
        console.print(line, highlight=False, markup=False, soft_wrap=True)
