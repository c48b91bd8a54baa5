"""Task fidelity: does the view rank plants as a slow and exact one does; a table and fidelity.json."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from itertools import islice
from typing import Any, cast

from omegaconf import DictConfig
from rich.console import Console
from rich.table import Table

from experiments.build import build
from experiments.gl_fidelity import gl_agreement
from experiments.numbers import rounded
from experiments.pictures import EXAMPLES, examples
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.view_fidelity import REFERENCE_ROWS, Agreement, measure, random_plants
from treefit.image import AutoMask, read_picture
from treefit.mask import Mask
from treefit.objective import View
from treefit.opengl import gl_missing
from treefit.plant import Generator
from treefit.similarity import Similarity
from treefit.view import Frame

GATE_ROWS, SPEARMAN, BEST_HALF, PIXELS = 128, 0.97, 0.93, 0.02
"""What a view must reach at GATE_ROWS: the two correlations, and pixels of a class at most that far from 1."""

GL_PLANTS = 6


def run(cfg: DictConfig) -> None:
    """Measure cfg.view with cfg.generator and cfg.similarity; write fidelity.json, print a table and one JSON line."""
    generator = cast(Generator, build(cfg.generator, "generator"))
    view = cast(View, build(cfg.view, "view"))
    similarity = cast(Similarity[Any], build(cfg.similarity, "similarity"))
    wanted = read_settings(cfg)
    found = measure(
        generator, view, parts(similarity), picture_masks(), wanted.fidelity.plants, wanted.fidelity.rows, wanted.seed
    )
    missing = gl_missing()
    by_gl = None if missing else _by_gl(generator, wanted.seed)
    facts = {
        "generator": generator.name, "plants": wanted.fidelity.plants,
        "view": [asdict(one) for one in found], "gates_missed": missed(found), "pyrender": by_gl or missing,
    }  # fmt: skip
    (run_folder() / "fidelity.json").write_text(json.dumps(facts, indent=1), encoding="utf-8")
    console = Console()
    console.print(_table(found))
    for line in _remarks(found, by_gl, missing):
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    print(json.dumps(rounded(facts | {"view": len(found)}, 4)), flush=True)


def parts(similarity: Similarity[Any]) -> dict[str, Similarity[Any]]:
    """The similarity as `whole` and, when it is made of `terms`, each of them by name."""
    terms = getattr(similarity, "terms", {})
    return {"whole": similarity, **(terms if isinstance(terms, Mapping) else {})}


def picture_masks() -> list[Mask]:
    """Masks of the example pictures."""
    return [AutoMask()(read_picture(EXAMPLES / name)).mask for name in examples()]


def missed(found: Iterable[Agreement]) -> list[str]:
    """Gates that the whole similarity does not reach at GATE_ROWS, one line each."""
    lines = []
    for one in found:
        if one.rows != GATE_ROWS or one.similarity != "whole":
            continue
        gates = {
            "spearman": (one.spearman, SPEARMAN, one.spearman_limit),
            "best half": (one.best_half, BEST_HALF, one.best_half_limit),
        }
        lines += [f"{name} {value:.3f} < {least} (the naive view reaches {limit:.3f})"
                  for name, (value, least, limit) in gates.items() if value < least]  # fmt: skip
        ratios = {"branch pixels": (one.branch_pixels, one.branch_pixels_limit),
                  "foliage pixels": (one.foliage_pixels, one.foliage_pixels_limit)}  # fmt: skip
        lines += [f"{name} {value:.3f} not within {PIXELS} of 1 (the naive view reaches {limit:.3f})"
                  for name, (value, limit) in ratios.items() if abs(value - 1) > PIXELS]  # fmt: skip
    return lines


def _by_gl(generator: Generator, seed: int) -> dict[str, float]:
    plants = list(islice((plant for plant in random_plants(generator, seed) if plant.n_leaves), GL_PLANTS))
    return gl_agreement(plants, Frame(REFERENCE_ROWS, REFERENCE_ROWS // 32))


def _table(found: Iterable[Agreement]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    for name in ("rows", "similarity", "all", "least", "limit", "half", "least", "limit", "wood", "limit", "leaf",
                 "limit"):  # fmt: skip
        table.add_column(name, justify="left" if name == "similarity" else "right", no_wrap=True)
    for one in found:
        numbers = (one.spearman, one.spearman_least, one.spearman_limit, one.best_half, one.best_half_least,
                   one.best_half_limit, one.branch_pixels, one.branch_pixels_limit, one.foliage_pixels,
                   one.foliage_pixels_limit)  # fmt: skip
        table.add_row(str(one.rows), one.similarity, *(f"{number:.3f}" for number in numbers))
    return table


def _remarks(found: list[Agreement], by_gl: dict[str, float] | None, missing: str | None) -> list[str]:
    lines = [
        f"against the naive view at {REFERENCE_ROWS} rows: rank correlation of scores over all plants and the best",
        "half, mean and least over the targets; pixels of wood and leaves of all plants by those of the naive view;",
        "limit: what the naive view itself reaches at the same rows",
    ]
    if any(one.rows == GATE_ROWS for one in found):
        lines.append(f"gates at {GATE_ROWS} rows: {'; '.join(missed(found)) or 'met'}")
    if by_gl is None:
        return [*lines, f"no comparison with pyrender: {missing}"]
    return [*lines, "naive view against pyrender: " + ", ".join(f"{name} {value:.3f}" for name, value in by_gl.items())]
