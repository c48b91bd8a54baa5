"""The page of the task compare: which optimiser is how good after how many evaluations, as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isnan

import numpy as np

from experiments.compare_statistics import (
    Column,
    Group,
    differences,
    friedman,
    means,
    quartiles,
    ranks,
    signed_rank,
)
from experiments.compare_study import ALL, Study, own_time
from experiments.markdown import LEFT, command, table, versions

HOW = """Every optimizer searches every target from the same seeds, with the same number of evaluations; the score
is that of the best plant so far. All numbers come from whole searches: one that plans its course by its budget, as a
tree of GAs does, may do better at 1,000 when it is given no more than that. Repeats of a target are averaged before
anything else, so errors and tests are over targets. ± is a standard error: that of a score is mostly how unlike the
targets are, that of a difference is paired, target by target, and so are the bands of the plots. A difference is bold
when the optimizer beats the first one by over two standard errors."""

FURTHER = """`reach`: evaluations to the score that {reference} has at the end on the same target and seed, median
[quartiles] over all searches, and the share of them that got there. `p`: Wilcoxon's signed-rank test against the first
optimizer over targets, at the end. `rank`: mean over targets, 1 is best{friedman}. `own time`: what the optimizer takes
itself of the processor time of a search, `seconds`, on one core."""


def page(study: Study, given: Iterable[str], figures: Sequence[str]) -> str:
    """All tables, with the `given` settings of the command line that make them and the addresses of the `figures`."""
    wanted = study.wanted
    groups = [*study.groups, *([study.whole] if study.whole else [])]
    recipes = [[name, f"`{recipe}`"] for name, recipe in study.recipes.items()]
    so_far = (
        "" if len(study.runs) == study.planned else f" So far {len(study.runs)} of {study.planned} searches are done."
    )
    return "\n".join([
        "# Optimizers", "", HOW + so_far, "",
        f"Made by `{command(given)}`",
        f"with {versions()}: {wanted.evaluations:,} evaluations a search, seeds {study.seed} to "
        f"{study.seed + wanted.repeats - 1}.", "",
        *(line for figure in figures for line in (f"![Score by evaluations]({figure})", "")),
        *(line for group in groups for line in _group(study, group)),
        "## Settings", "", *table(["optimizer", "settings"], recipes, [LEFT, LEFT]), "",
    ])  # fmt: skip


def _group(study: Study, group: Group) -> list[str]:
    budgets = study.wanted.columns
    title = group.name if group.name == ALL else f"{group.name} (`{study.versions[group.name]}`)"
    scores = [group.at(budget) for budget in budgets]
    head = ["optimizer", *(f"{budget:,}" for budget in budgets)]
    count = f"{len(group.targets)} targets, {len(group.places)} searches by each optimizer."
    return [
        f"## {title[0].upper()}{title[1:]}", "", count, "", "### Score by evaluations", "",
        *table(head, _columns(group.optimizers, [_with_errors(*means(one)) for one in scores])), "",
        f"### Difference to {group.optimizers[0]}", "",
        *table(head, _columns(group.optimizers, [_apart(*differences(one)) for one in scores])), "",
        "### At the end", "", *_end(study, group), "",
        *([] if group.name == ALL else ["### By target, at the end", "", *_by_target(study, group), ""]),
    ]  # fmt: skip


def _end(study: Study, group: Group) -> list[str]:
    end = study.wanted.evaluations
    scores, others = group.at(end), group.on_other_seeds
    reference = group.stronger(study.wanted.reference, end)
    columns = {
        "reach": [_reach(group, one, reference, end) for one in group.optimizers],
        "p": ["" if isnan(p) else f"{p:.2g}" for p in signed_rank(scores)],
        "rank": [f"{rank:.2f}" for rank in ranks(scores)],
        f"on {study.other_seeds} other seeds": _with_errors(*means(others)),
        f"there, to {group.optimizers[0]}": _apart(*differences(others)),
        "own time": [f"{own_time(group.of_optimizer(one)):.1%}" for one in group.optimizers],
        "seconds": [f"{np.mean([run.seconds for run in group.of_optimizer(one)]):.1f}" for one in group.optimizers],
    }
    all_alike = friedman(scores)
    told = FURTHER.format(
        reference=reference or "the reference (none was run)",
        friedman="" if isnan(all_alike) else f" (that all are alike has p = {all_alike:.2g})",
    )
    return [told, "", *table(["optimizer", *columns], _columns(group.optimizers, list(columns.values())))]


def _by_target(study: Study, group: Group) -> list[str]:
    scores = group.at(study.wanted.evaluations)
    rows = []
    for target, column in zip(group.targets, scores.T, strict=True):
        best = f"{column.max():.4f}"
        rows.append([target, *(f"**{score:.4f}**" if f"{score:.4f}" == best else f"{score:.4f}" for score in column)])
    return table(["target", *group.optimizers], rows)


def _columns(names: Sequence[str], columns: Sequence[Sequence[str]]) -> list[list[str]]:
    """Rows of a table with the `names` before the `columns`."""
    return [list(row) for row in zip(names, *columns, strict=True)]


def _with_errors(mean: Column, error: Column) -> list[str]:
    return [_words(one, by) for one, by in zip(mean, error, strict=True)]


def _apart(mean: Column, error: Column) -> list[str]:
    shown = ["", *(_words(one, by, "+") for one, by in zip(mean[1:], error[1:], strict=True))]
    return [f"**{words}**" if one > 2 * by else words for words, one, by in zip(shown, mean, error, strict=True)]


def _words(mean: float, error: float, sign: str = "") -> str:
    if isnan(mean):
        return "-"
    return f"{mean:{sign}.4f}" + ("" if isnan(error) else f" ± {error:.4f}")


def _reach(group: Group, optimizer: str, reference: str | None, end: int) -> str:
    if reference is None:
        return "-"
    counts = group.reach(optimizer, reference, end)
    low, median, high = ("never" if count > end else f"{count:,.0f}" for count in quartiles(counts))
    return f"{median} [{low}, {high}], {np.mean([count <= end for count in counts]):.0%}"
