"""The page of the task masks: means by extractor, and picture by picture, as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby

import numpy as np

from experiments.markdown import LEFT, RIGHT, command, table, versions
from experiments.masks_measure import MEASURES, Found

HOW = """`tree IoU`: tree against background, `least` of all pictures; `3-class IoU`: mean over background, branch and
foliage; `s`: processor time of one picture once it is read."""


def page(found: Sequence[Found], given: Iterable[str]) -> str:
    """All tables of what was `found`, with the `given` settings of the command line that make them."""
    methods = list(dict.fromkeys(one.method for one in found))
    judged = [one for one in found if one.agreement is not None]
    lines = ["# Masks", "", HOW, "", f"Made by `{command(given)}`", f"with {versions()}.", ""]
    if judged:
        head = ["extractor", "pictures", *MEASURES.values(), "least", "s"]
        rows = [_row(name, list(group)) for name, group in groupby(judged, lambda one: one.name)]
        lines += [*table(head, [_means(method, found) for method in methods]), "", "## By picture", "",
                  "Tree / 3-class / branch IoU.", "", *table(["picture", *methods], rows), ""]  # fmt: skip
    told = [[one.name, one.method, _certain(one), one.error or _said(one)] for one in found]
    return "\n".join(
        [*lines, "## What each said", "", *table(["picture", "by", "sure", "why"], told, [LEFT, LEFT, RIGHT, LEFT]), ""]
    )


def means(method: str, found: Sequence[Found]) -> dict[str, float]:
    """Means over the pictures that have a reference."""
    of_it = [one for one in found if one.method == method]
    told = [one.agreement for one in of_it if one.agreement is not None]
    facts = {name: float(np.nanmean([one[name] for one in told])) if told else float("nan") for name in MEASURES}
    least = min((one["tree"] for one in told), default=float("nan"))
    return {"pictures": len(told), **facts, "least": least, "seconds": float(np.mean([one.seconds for one in of_it]))}


def _means(method: str, found: Sequence[Found]) -> list[str]:
    told = means(method, found)
    numbers = [f"{told[name]:.3f}" for name in (*MEASURES, "least")]
    return [method, f"{told['pictures']:.0f}", *numbers, f"{told['seconds']:.2f}"]


def _row(name: str, found: Sequence[Found]) -> list[str]:
    return [name, *(" / ".join(f"{(one.agreement or {})[measure]:.2f}" for measure in MEASURES) for one in found)]


def _certain(one: Found) -> str:
    return "" if one.extraction is None else f"{one.extraction.confidence:.2f}"


def _said(one: Found) -> str:
    return "" if one.extraction is None else "; ".join([one.extraction.why, *one.extraction.warnings])
