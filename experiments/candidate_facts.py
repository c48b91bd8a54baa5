"""CandidateFacts: what is known of a candidate, with its name, words and unit, for all files and pages that tell it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass

from treefit.asset import MeshCounts, TreeFiles
from treefit.candidates import Candidate

OTHER_SEEDS = "other_seeds"
"""Marks the mean of a fact over the same values on other seeds, in the names that programs read."""

AGREEMENT, DETAIL, TREE = "agreement", "more measures", "tree"
"""Groups that facts are shown in."""

Number = float | int


@dataclass(frozen=True)
class Fact:
    """One thing known of a candidate: `name` for programs, `words` with `unit` and `digits` for people.

    `here` reads it of the candidate itself, `elsewhere`, where there is such a thing, its mean over other seeds.
    """

    name: str
    words: str
    group: str
    meaning: str
    here: Callable[[Candidate, MeshCounts], Number]
    elsewhere: Callable[[Candidate], float | None] | None = None
    unit: str = ""
    digits: int = 2
    signed: bool = False

    def value(self, number: Number | None) -> str:
        """Return a number as people read it, "-" when it is not known."""
        if number is None:
            return "-"
        sign = "+" if self.signed else ""
        return f"{number:{sign},.{self.digits}f}{' ' if self.unit else ''}{self.unit}"

    def phrase(self, number: Number | None) -> str:
        """Return name and number in words: "score 0.812", "2,134 vertices"."""
        told = self.value(number)
        return f"{told} {self.words}" if self.digits == 0 else f"{self.words} {told}"


def _measure(name: str, words: str, group: str, meaning: str, unit: str = "", signed: bool = False) -> Fact:
    """Fact of a field of Agreement."""

    def elsewhere(found: Candidate) -> float | None:
        return None if found.agreement_other_seeds is None else float(getattr(found.agreement_other_seeds, name))

    def here(found: Candidate, _: MeshCounts) -> float:
        return float(getattr(found.agreement, name))

    return Fact(name, words, group, meaning, here, elsewhere, unit, 1 if unit else 2, signed)


FACTS = (
    Fact("score", "score", AGREEMENT, "what was searched for: image similarity times the multipliers of the wishes",
         lambda found, _: found.score.total, lambda found: found.score_other_seeds, digits=3),
    Fact("image_similarity", "image similarity", AGREEMENT, "the score without the wishes",
         lambda found, _: found.score.image, digits=3),
    _measure("silhouette_iou", "silhouette IoU", AGREEMENT, "silhouettes: pixels in both by pixels in either"),
    _measure("hull_iou", "hull IoU", AGREEMENT, "the same with every row filled from border to border"),
    _measure("class_iou", "class IoU", AGREEMENT, "the same, mean of background, branches and leaves"),
    _measure("texture", "texture", AGREEMENT, "as open, broken and ragged as the picture, band by band: 1"),
    _measure("contour_distance", "contour distance", AGREEMENT,
             "mean distance between the outlines in percent of the height", "%"),
    _measure("branch_iou", "branch IoU", DETAIL, "pixels of branches in both by those in either"),
    _measure("fill_ratio", "fill ratio", DETAIL, "share of the hull that is filled, by the picture's"),
    _measure("runs_ratio", "runs ratio", DETAIL, "pieces that a row is broken into, by the picture's"),
    _measure("roughness_ratio", "roughness ratio", DETAIL, "raggedness of the borders, by the picture's"),
    _measure("bare_trunk_error", "bare trunk", DETAIL,
             "height of the crown's foot, less the picture's, in percent of the height", "%", signed=True),
    _measure("trunk_width_error", "trunk width", DETAIL,
             "less the picture's, in percent of the height", "%", signed=True),
    Fact("vertices", "vertices", TREE, "joints of its stems", lambda found, _: found.plant.n_vertices, digits=0),
    Fact("leaves", "leaves", TREE, "leaves", lambda found, _: found.plant.n_leaves, digits=0),
    Fact("triangles", "triangles", TREE, "triangles of its finest mesh", lambda _, mesh: mesh.triangles, digits=0),
    Fact("height_m", "height", TREE, "height", lambda found, _: found.extent.height, unit="m", digits=1),
    Fact("width_m", "width", TREE, "width", lambda found, _: found.extent.width, unit="m", digits=1),
)  # fmt: skip

BY_NAME: Mapping[str, Fact] = {fact.name: fact for fact in FACTS}


def record(found: Candidate, mesh: MeshCounts) -> dict[str, Number | None]:
    """All facts by name, for files; the mean over other seeds is `<name>_other_seeds`, None when there is none."""
    told: dict[str, Number | None] = {}
    for fact in FACTS:
        told[fact.name] = fact.here(found, mesh)
        if fact.elsewhere is not None:
            told[f"{fact.name}_{OTHER_SEEDS}"] = fact.elsewhere(found)
    return told


def metrics(found: Candidate, mesh: MeshCounts) -> dict[str, float]:
    """All facts that are known, for the tracker, to four digits; more measures are under `more/`.

    The mean of the others over other seeds is `<name>_other_seeds`.
    """
    told: dict[str, float] = {}
    for fact in FACTS:
        name = f"more/{fact.name}" if fact.group == DETAIL else fact.name
        told[name] = round(float(fact.here(found, mesh)), 4)
        other = fact.elsewhere(found) if fact.elsewhere is not None and fact.group != DETAIL else None
        if other is not None:
            told[f"{name}_{OTHER_SEEDS}"] = round(other, 4)
    return told


def level_facts(tree: TreeFiles) -> dict[str, object]:
    """Levels of detail of a tree and the names of its files, for JSON."""
    return {"levels": [asdict(level) for level in tree.levels], "files": [*tree.names]}


def level_columns(tree: TreeFiles) -> dict[str, Number]:
    """Levels of detail but the whole model, for a table: `triangles_LOD1`, `silhouette_iou_LOD1` and so on."""
    columns: dict[str, Number] = {}
    for level in tree.levels[1:]:
        number = level.name.rpartition("_")[2]
        columns |= {f"triangles_{number}": level.triangles, f"silhouette_iou_{number}": level.silhouette_iou}
    return columns
