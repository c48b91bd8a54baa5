"""Forest of the task grow: the same values on many seeds, a folder each, and all of them side by side on a sheet."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from PIL import Image

from experiments.dressing import look_of
from experiments.errors import UserError
from experiments.settings import Strip
from experiments.sheet_cells import grow
from experiments.strip_page import Moment, strip_page
from experiments.terminal import counted
from treefit.asset import AssetSettings, TreeColours, picture, write_tree
from treefit.plant import Generator, Plant, Values, write_preset
from treefit.plant.extent import extent_of

SHEET = Strip(height=260)
"""How the sheet is drawn."""

_log = logging.getLogger(__name__)


def write_forest(
    folder: Path, generator: Generator, values: Values, seeds: Sequence[int], asset: AssetSettings, title: str
) -> dict[str, object]:
    """Write trees/<seed>/ for each of `seeds`, and sheet.png; names of the files by seed, and what failed.

    UserError when no seed has a tree.
    """
    grown: dict[int, Plant | str] = {}
    files: dict[str, dict[str, str]] = {}
    for seed in counted(seeds, "trees"):
        grown[seed] = plant = grow(generator, values, seed)
        if isinstance(plant, Plant):
            files[str(seed)] = _write_tree(folder / "trees" / str(seed), generator, values, seed, plant, asset)
        else:
            _log.warning("seed %s: %s", seed, plant)
    if not files:
        raise UserError(f"seeds: none of the {len(seeds)} has a tree: {grown[seeds[0]]}")
    legend = "The same values on other seeds, all at one scale."
    strip_page([_moment(seed, grown[seed]) for seed in seeds], SHEET, asset, title, legend).save(folder / "sheet.png")
    failed = {str(seed): plant for seed, plant in grown.items() if isinstance(plant, str)}
    return {"seeds": list(seeds), "trees": files, "sheet": str(folder / "sheet.png"), "failed": failed}


def _write_tree(
    folder: Path, generator: Generator, values: Values, seed: int, plant: Plant, asset: AssetSettings
) -> dict[str, str]:
    folder.mkdir(parents=True, exist_ok=True)
    names = write_tree(folder, plant, asset).names
    Image.fromarray(picture(plant, asset)).save(folder / "picture.png")
    write_preset(folder / "preset.yaml", generator=generator.name, version=generator.version, seed=seed, values=values,
                 look=look_of(asset, TreeColours()))  # fmt: skip
    return {name: str(folder / name) for name in (*names, "picture.png", "preset.yaml")}


def _moment(seed: int, plant: Plant | str) -> Moment:
    name = f"seed {seed}"
    if isinstance(plant, str):
        return Moment(plant, name, ())
    facts = (f"{extent_of(plant).height:,.1f} m", f"{plant.n_vertices:,} vertices", f"{plant.n_leaves:,} leaves")
    return Moment(plant, name, facts)
