"""What people are shown of a candidate: a row in the terminal, a caption in the gallery, tables in the viewer."""

from __future__ import annotations

from experiments.candidate_facts import AGREEMENT, BY_NAME, DETAIL, FACTS, OTHER_SEEDS, TREE, Fact, record
from treefit.asset import FactRow, FactTable, MeshCounts
from treefit.candidates import Candidate

ROW = ("score", "score_other_seeds", "silhouette_iou", "hull_iou", "class_iou", "texture", "vertices", "leaves",
       "triangles", "height_m")  # fmt: skip
"""Facts in the terminal's table, which fits 80 columns."""

CAPTION = (("score", "score_other_seeds"), ("silhouette_iou", "hull_iou"), ("class_iou", "texture"),
           ("vertices", "leaves"))  # fmt: skip
"""Facts in the lines of a caption."""


def row(number: int, found: Candidate, mesh: MeshCounts) -> dict[str, str]:
    """Row of the terminal's table, by column."""
    known = record(found, mesh)
    return {"#": str(number)} | {_words(name): _fact(name).value(known[name]) for name in ROW}


def caption(found: Candidate, mesh: MeshCounts) -> tuple[str, ...]:
    """Lines under a candidate in the gallery; what is not known is left out."""
    known = record(found, mesh)
    lines = ([name for name in line if known[name] is not None] for line in CAPTION)
    return tuple(", ".join(_phrase(name, known[name]) for name in line) for line in lines)


def tables(found: Candidate, mesh: MeshCounts) -> list[FactTable]:
    """Tables of the viewer page: how well it agrees, more of that folded away, and the tree itself."""
    others = found.score_other_seeds is not None
    columns = ("this tree", "other seeds") if others else ("this tree",)
    return [
        FactTable("How alike", _rows(AGREEMENT, found, mesh, others), columns),
        FactTable("More measures", _rows(DETAIL, found, mesh, others), columns, folded=True),
        FactTable("Tree", _rows(TREE, found, mesh, False)),
    ]


def _rows(group: str, found: Candidate, mesh: MeshCounts, others: bool) -> list[FactRow]:
    rows = []
    for fact in (fact for fact in FACTS if fact.group == group):
        values = [fact.value(fact.here(found, mesh))]
        if others:
            values.append("" if fact.elsewhere is None else fact.value(fact.elsewhere(found)))
        rows.append(FactRow(fact.words, tuple(values), fact.meaning))
    return rows


def _fact(name: str) -> Fact:
    return BY_NAME[name.removesuffix(f"_{OTHER_SEEDS}")]


def _words(name: str) -> str:
    return "other seeds" if name == f"score_{OTHER_SEEDS}" else _fact(name).words


def _phrase(name: str, value: float | int | None) -> str:
    return f"{_words(name)} {_fact(name).value(value)}" if name.endswith(OTHER_SEEDS) else _fact(name).phrase(value)
