"""What the task adapt shows in the terminal: what grew, how fast, what each parameter does, and the next command."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from experiments.adapting.ends import reasons
from experiments.adapting.findings import Findings
from experiments.adapting.trial import ENOUGH
from experiments.sheet_values import written
from treefit.plant import Parameter, Value

MOST_NAMES, FEW = 5, 3  # names and choices on a line
_WIDEST = 60  # signs of a cell; it goes on below in a narrow terminal


def print_findings(found: Findings, files: Mapping[str, Path], command: str, console: Console | None = None) -> None:
    """Print a table, what else was found, the `files` by what they are, and the command to go on with."""
    console = console or Console()
    console.print(_table(found))
    for line in [*_lines(found), *(f"{name:<9}{path}" for name, path in files.items())]:
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    console.print(f"next     {command}", highlight=False, markup=False, soft_wrap=True)


def _table(found: Findings) -> Table:
    """A row a searched parameter."""
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    for name in ("parameter", "example", "range", "changes", "fails low", "fails high"):
        text = name in ("parameter", "range")
        table.add_column("\n".join(name.split()), justify="left" if text else "right", vertical="bottom",
                         overflow="fold", no_wrap=name != "range")  # fmt: skip
    for one in found.searched:
        assert one.parameter is not None
        effect, ends = found.effects.get(one.name), found.ends.get(one.name)
        changes = f"{effect.mean:.0%}" if effect and effect.tried else "–"
        fails = [_marked(share, ends.at_fault == end) for end, share in (("low", ends.low), ("high", ends.high))] \
            if ends else ["", ""]  # fmt: skip
        cells = [_short(one.name), _short(_value(one.value)), _short(_range(one.parameter))]
        table.add_row(*(escape(cell) for cell in cells), changes, *fails)
    return table


def _marked(share: float, at_fault: bool) -> str:
    return f"[bold red]{share:.0%}[/]" if at_fault else f"{share:.0%}"


def _lines(found: Findings) -> Iterator[str]:
    trial, seconds = found.trial, found.seconds
    yield ""
    yield from _fixed(found)
    yield f"{'example':<9}{found.source}" + ("" if found.example.grew else f": no tree: {found.example.reason}")
    for note in found.notes:
        yield f"{'':<9}left out: {note}"
    yield f"{'trees':<9}{len(trial.good)} of {len(trial.trees)} random genomes grow one ({trial.share:.0%})"
    for count, kind, first in reasons(trial):
        yield f"{'':<9}{count} {kind}: {first}"
    yield from _narrowed(found)
    yield (f"{'call':<9}median {_time(seconds['median'])}, 95 % under {_time(seconds['p95'])}, "
           f"longest {_time(seconds['max'])}")  # fmt: skip
    if trial.good:
        vertices, leaves = found.vertices, found.leaves
        yield (f"{'size':<9}median {vertices['median']:,.0f} vertices and {leaves['median']:,.0f} leaves, "
               f"95 % under {vertices['p95']:,.0f} and {leaves['p95']:,.0f}")  # fmt: skip
    same, of = found.repeated
    unlike = "" if same == of else ": a search needs the same tree again; draw all from the seed of the request"
    yield f"{'again':<9}the same input gave the same tree {same} times of {of}{unlike}"


def _narrowed(found: Findings) -> Iterator[str]:
    """What was tried before, and what is to do when it was not enough."""
    for one in found.before:
        failures = ", ".join(f"{count} {kind}: {first}" for count, kind, first in one.failures)
        names = ", ".join(one.narrowed) if len(one.narrowed) <= MOST_NAMES else f"{len(one.narrowed)} parameters"
        yield f"{'':<9}before, {one.share:.0%} did ({failures}); narrowed around the example: {names}"
    if found.trial.share < ENOUGH:
        yield f"{'':<9}under {ENOUGH:.0%}: narrow ranges in space.yaml, and try it: task=adapt generator.space=..."


def _fixed(found: Findings) -> Iterator[str]:
    """A line a reason, with the names of what is fixed for it."""
    names: dict[str, list[str]] = {}
    for one in found.fixed:
        names.setdefault(one.reason, []).append(one.name)
    for i, (reason, own) in enumerate(names.items()):
        yield f"{'' if i else 'fixed':<9}{', '.join(own)}: {reason}"


def _range(parameter: Parameter) -> str:
    if parameter.kind == "choice":
        return " | ".join(parameter.choices) if len(parameter.choices) <= FEW else f"{len(parameter.choices)} choices"
    if parameter.kind == "bool":
        return "no | yes"
    low, high = (written(int(end) if parameter.kind == "int" else end, "") for end in (parameter.low, parameter.high))
    marks = [mark for mark, there in (("whole", parameter.kind == "int"), ("log", parameter.scale == "log")) if there]
    return f"{low} to {high}" + (f" ({', '.join(marks)})" if marks else "")


def _value(value: Value) -> str:
    return written(value, "")


def _short(text: str) -> str:
    return text if len(text) <= _WIDEST else text[: _WIDEST - 1] + "…"


def _time(seconds: float) -> str:
    if seconds >= 1:
        return f"{seconds:.3g} s"
    return f"{1000 * seconds:.0f} ms" if seconds >= 0.01 else f"{1000 * seconds:.1f} ms"
