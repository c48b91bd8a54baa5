"""The page of the task similarities: means by similarity, and picture by picture, as Markdown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from experiments.markdown import LEFT, command, table, versions
from experiments.similarities_fit import Study
from treefit.similarity import Mix
from treefit.similarity.measures import Agreement


@dataclass(frozen=True)
class Measure:
    """A field of Agreement as a column; `size` makes of an error its size, `worse` says how bad a mean is."""

    field: str
    words: str
    digits: int = 3
    size: Callable[[float], float] = float
    worse: Callable[[float], float] = lambda mean: -mean

    def of(self, agreement: Agreement) -> float:
        """Number of one fit."""
        return self.size(getattr(agreement, self.field))


MEASURES = (
    Measure("silhouette_iou", "silhouette IoU"),
    Measure("hull_iou", "hull IoU"),
    Measure("contour_distance", "contour, %", 2, worse=float),
    Measure("class_iou", "class IoU"),
    Measure("branch_iou", "branch IoU"),
    Measure("texture", "texture"),
    Measure("fill_ratio", "fill ratio", 2, worse=lambda mean: abs(mean - 1)),
    Measure("runs_ratio", "runs ratio", 2, worse=lambda mean: abs(mean - 1)),
    Measure("roughness_ratio", "roughness ratio", 2, worse=lambda mean: abs(mean - 1)),
    Measure("bare_trunk_error", "bare trunk off, %", 1, size=abs, worse=float),
    Measure("trunk_width_error", "trunk width off, %", 2, size=abs, worse=float),
)
BY_PICTURE = tuple(one for one in MEASURES if one.field in ("silhouette_iou", "class_iou", "hull_iou", "texture"))

HOW = """Each picture is fitted by each similarity, and the best tree is judged at 256 rows by measures that were not
the score of the search. They are not equally free of it: `classes` is near to class and branch IoU, `texture` to
texture and the ratios, `trunk` to the two errors of the trunk. No term is like the hull IoU and the contour distance.
`%` are percent of the height, errors are averaged without their sign, and the best of a column is bold."""


def page(study: Study, given: Iterable[str]) -> str:
    """All tables, with the `given` settings of the command line that make them."""
    common = _common(study)
    count = f"Means over {len(common)} picture{'s' if len(common) != 1 else ''} that every similarity has."
    return "\n".join([
        "# Similarities", "", HOW, "",
        f"Made by `{command(given)}`",
        f"with {versions()}: `{study.generator}`, {study.evaluations:,} evaluations a fit, seed {study.seed}.", "",
        *table(["similarity", "made of"], [[name, _recipe(mix)] for name, mix in study.mixes.items()], [LEFT] * 2), "",
        "## The trees that were found", "", count, "", *_means(study, others=False), "",
        *([f"## The same values on {study.other_seeds} other seeds", "", *_means(study, others=True), ""]
          if study.other_seeds else []),
        *(line for measure in BY_PICTURE for line in _by_picture(study, measure)),
    ])  # fmt: skip


def means(study: Study, others: bool = False) -> dict[str, dict[str, float]]:
    """Means of every measure by similarity, of the trees themselves or of `others`, on other seeds.

    They are over the pictures that every similarity has; the seconds of the search are with the trees themselves.
    """
    found: dict[str, dict[str, float]] = {}
    for name in study.mixes:
        fits = [study.by_pair[picture, name] for picture in _common(study) if (picture, name) in study.by_pair]
        judged = [one for fit in fits if (one := fit.agreement_other_seeds if others else fit.agreement)]
        if judged:
            found[name] = {each.field: float(np.mean([each.of(one) for one in judged])) for each in MEASURES}
            found[name] |= {} if others else {"seconds": float(np.mean([fit.seconds for fit in fits]))}
    return found


def _common(study: Study) -> list[str]:
    """Pictures that every similarity has, but for similarities that have none at all."""
    names = {fit.similarity for fit in study.fits}
    return [picture for picture in study.pictures if all((picture, name) in study.by_pair for name in names)]


def _means(study: Study, others: bool) -> list[str]:
    found = means(study, others)
    columns = {}
    for each in MEASURES:
        columns[each.words] = _column([row[each.field] for row in found.values()], each)
    if not others:
        columns["seconds"] = [f"{row['seconds']:.1f}" for row in found.values()]
    return table(["similarity", *columns], list(zip(found, *columns.values(), strict=True)))


def _by_picture(study: Study, measure: Measure) -> list[str]:
    rows = []
    for picture in study.pictures:
        fits = [study.by_pair.get((picture, name)) for name in study.mixes]
        rows.append([picture, *_column([measure.of(fit.agreement) if fit else None for fit in fits], measure)])
    return [f"## {measure.words[0].upper()}{measure.words[1:]} by picture", "",
            *table(["picture", *study.mixes], rows), ""]  # fmt: skip


def _column(numbers: Sequence[float | None], measure: Measure) -> list[str]:
    """Numbers in words, the best bold, "-" for None."""
    shown = ["-" if number is None else f"{number:.{measure.digits}f}" for number in numbers]
    known = [(measure.worse(number), i) for i, number in enumerate(numbers) if number is not None]
    best = shown[min(known)[1]] if len(known) > 1 else None
    return [f"**{text}**" if text == best else text for text in shown]


def _recipe(mix: Mix) -> str:
    """Weights of the terms that count: "0.4 soft + 0.6 texture"."""
    weights = {name: weight for name, weight in mix.weights.items() if weight > 0}
    if mix.combine == "product":
        return " · ".join(f"{name}^{weight:g}" for name, weight in weights.items())
    return " + ".join(f"{weight:g} {name}" for name, weight in weights.items())
