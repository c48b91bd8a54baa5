"""Write generators/weberpenn/reference.md: WeberPennGen beside Arbaro and tree-gen with the same parameters.

Usage: python scripts/weberpenn_reference.py [--seeds 10] [--file generators/weberpenn/reference.md]
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from census import Census, census

from generators.weberpenn import WeberPennGen
from generators.weberpenn.parameters import FULL
from treefit.plant import Budget, Value
from treefit.plant.preset import read_preset

ROOT = Path(__file__).parents[1]
MEASURED = ROOT / "tests/generators/weberpenn_reference.yaml"
FIRST_SEED = 101  # none of those that the other programs ran
NO_SPLITS: dict[str, Value] = {"base_splits": 0, **{f"seg_splits_{n}": 0.0 for n in range(4)}}
TOOLS = {"arbaro": "Arbaro", "tree_gen": "tree-gen"}

HEAD = """\
# WeberPennGen beside Arbaro and tree-gen

Means over seeds of the four published species, all three programs with the same parameters: those of Arbaro's files.
Where these are not the paper's, the presets in `species/` have the paper's values:
{differ}.
Arbaro is {arbaro};
tree-gen is {tree_gen}.

Lengths and radii are those of the stems of a level by those of the trunk; height is by the length of the trunk, whose
`scale_v` would hide all else. `+` are clones. Ours are of the seeds from {first} on, which the others did not run.
`python scripts/weberpenn_reference.py` writes this page; the others' figures are in
`tests/generators/weberpenn_reference.yaml`, and `tests/generators/test_weberpenn_reference.py` holds ours to them.
"""

RULES = """\
## The rule of splits

A clone is no new stem. At a split the children that a stem has still to get are shared among it and its clones, so that
`branches_n` stays the count of children of a stem whatever its splits, as in Arbaro. In tree-gen every clone that
`base_splits` makes has `branches_1` children of its own, which gives its oak and its willow 2.5 times the stems, while
splits of segments give it fewer. Without splits all three agree. How many clones a segment ends with is diffused along
each stem from a random start; clones split as their stems do, so that a stem of `curve_res` segments has
(1 + seg_splits)^(curve_res - 1) - 1 clones in the mean. Arbaro has as many at level 1 and on the oak, a fifth fewer
on the twigs of the willow.

## The rule of leaves

A stem of the last level has `leaves` x ShapeRatio(4, r) leaves: half of `leaves` where it stands at the foot of its
parent, all at its tip; rounded up or down by a draw of the stem, so that the mean is exact, and shared among its
clones. Arbaro has the same ratio, but as many leaves on its willow as if every twig had all of them; tree-gen counts
leaves by the length of a stem.

## What else is not the same

A child at the share x of its parent is shorter by 0.6 x from level 2 on, which is the paper's; tree-gen has 0.7, hence
its shorter stems. Pruned stems of the willow are as long as fits the envelope, by bisection; those of the others come
out somewhat shorter. The variation of the trunk's radius, `scale_v_0`, is drawn here; the others' trunks have the mean.
tree-gen's thinnest twigs are thicker than the formula. Our trunk has up to four vertices more, for its flare.
"""


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--seeds", type=int, default=10)
    options.add_argument("--file", type=Path, default=ROOT / "generators/weberpenn/reference.md")
    chosen = options.parse_args()
    known: dict[str, Any] = yaml.safe_load(MEASURED.read_text(encoding="utf-8"))
    chosen.file.write_text(page(known, chosen.seeds), encoding="utf-8")


def page(known: dict[str, Any], seeds: int) -> str:
    """Markdown page of all species."""
    species = known["species"]
    differ = "; ".join(
        f"{_title(name)} "
        + ", ".join(f"`{key}` {_paper(name)[key]} (there {value})" for key, value in one["differ"].items())
        for name, one in species.items()
        if one["differ"]
    )
    sections = [section(name, one, seeds) for name, one in species.items()]
    return "\n".join([HEAD.format(**known["tools"], differ=differ, first=FIRST_SEED), *sections, RULES])


def section(name: str, one: dict[str, Any], seeds: int) -> str:
    """Table of one species."""
    values = {**_paper(name), **one["differ"]}
    lines = [
        f"## {_title(name).capitalize()}\n",
        "| | seeds | height | stems by level | nodes | leaves | length by level | radius by level |",
        "|---|---|---|---|---|---|---|---|",
        _our_row(grow(values, seeds)),
    ]
    for tool, title in TOOLS.items():
        its = one[tool]
        height = its["height"] / its["trunk_length"]
        rest = (its["nodes"], its["leaves"], its["length_ratio"], its["radius_ratio"])
        lines.append(_row(title, its["seeds"], height, its["stems"], its["clones"], *rest))
    if "splits_off" in one["arbaro"]:
        ours = np.mean([each.stems for each in grow({**values, **NO_SPLITS}, seeds)], axis=0)
        others = [f"{title} {_stems(one[tool]['splits_off'])}" for tool, title in TOOLS.items()]
        lines.append(f"\nStems without splits: ours {_stems(ours)}, {', '.join(others)}.")
    return "\n".join(lines) + "\n"


def grow(values: dict[str, Value], seeds: int) -> list[Census]:
    """Count plants of so many seeds."""
    whole, budget = FULL.complete(values), Budget(300_000, 1_000_000)
    plants = [WeberPennGen()(whole, FIRST_SEED + i, budget) for i in range(seeds)]
    return [census(plant, float(whole["flare"])) for plant in plants]


def _our_row(counted: list[Census]) -> str:
    def mean(what: str) -> Any:
        return np.mean([getattr(one, what) for one in counted], axis=0)

    height = float(np.mean([one.height / one.length[0] for one in counted]))
    length, radius = (
        np.mean([getattr(one, w) / getattr(one, w)[0] for one in counted], axis=0) for w in ("length", "radius")
    )
    return _row(
        "ours", len(counted), height, mean("stems"), mean("clones"), mean("vertices"), mean("leaves"), length, radius
    )


def _row(
    title: str, seeds: int, height: float, stems: Sequence[float], clones: Sequence[float], nodes: float, leaves: float,
    length: Sequence[float], radius: Sequence[float],
) -> str:  # fmt: skip
    cells = [title, str(seeds), f"{height:.3f}", _stems(stems, clones), f"{nodes:,.0f}", f"{leaves:,.0f}"]
    return "| " + " | ".join([*cells, _ratios(length), _ratios(radius)]) + " |"


def _stems(stems: Sequence[float], clones: Sequence[float] = ()) -> str:
    """Text like 1+22 / 40+160."""
    extra = [*clones, *[0.0] * (len(stems) - len(clones))]
    return " / ".join(_near(n) + (f"+{_near(c)}" if c else "") for n, c in zip(stems, extra, strict=True))


def _near(number: float) -> str:
    return f"{number:,.0f}" if number >= 1000 else f"{number:.4g}"


def _ratios(ratios: Sequence[float]) -> str:
    return " / ".join(f"{ratio:.3g}" for ratio in ratios[1:])


def _paper(name: str) -> dict[str, Value]:
    return dict(read_preset(ROOT / "generators/weberpenn/species" / f"{name}.yaml").values)


def _title(name: str) -> str:
    return name.replace("_", " ")


if __name__ == "__main__":
    main()
