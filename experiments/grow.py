"""Task grow: a plant from a preset or plain values, as GLB, picture and counts; no picture of a tree is needed."""

from __future__ import annotations

import json
import logging
from pathlib import Path
from typing import cast

import numpy as np
from omegaconf import DictConfig
from PIL import Image

from experiments.build import build
from experiments.candidate_facts import level_facts
from experiments.dressing import dressed, look_of
from experiments.forest import write_forest
from experiments.preset import wanted_plant
from experiments.run_folder import run_folder
from experiments.settings import read_settings
from experiments.sheet_cells import BUDGET
from experiments.strip import write_strip
from experiments.strip_growth import Growth, shown_parameter
from treefit.asset import AssetSettings, TreeColours, picture, write_tree
from treefit.plant import Generator, Plant, Values, check_plant, write_preset
from treefit.plant.extent import extent_of

_log = logging.getLogger(__name__)


def run(cfg: DictConfig) -> None:
    """Grow cfg.generator from cfg.preset and cfg.values; write its files and print one JSON line last.

    With `seeds` there is one tree on each of them, and a sheet of all. With a strip, `strip_failed` says which years
    could not be shown, and why.
    """
    generator, folder = cast(Generator, build(cfg.generator, "generator")), run_folder()
    values, seed, look = wanted_plant(cfg, generator)
    asset = dressed(cast(AssetSettings, build(cfg.asset, "asset")), look)
    seeds = read_settings(cfg).seeds
    if seeds is not None:
        title = f"{generator.name} {generator.version}{f': {_preset(cfg)}' if cfg.preset else ''} on {len(seeds)} seeds"
        facts = write_forest(folder, generator, values, seeds, asset, title)
        print(json.dumps({"generator": generator.name, **facts}, ensure_ascii=False), flush=True)
        return
    plant = generator(values, seed, BUDGET)
    check_plant(plant)
    if plant.cut:
        _log.warning("cut at %s vertices and %s leaves: these values ask for more", plant.n_vertices, plant.n_leaves)
    tree = write_tree(folder, plant, asset)
    Image.fromarray(picture(plant, asset)).save(folder / "picture.png")
    write_preset(folder / "preset.yaml", generator=generator.name, version=generator.version, seed=seed, values=values,
                 look=look_of(asset, TreeColours()))  # fmt: skip
    strips, failed = _strip(cfg, generator, values, seed, asset)
    facts = {
        "generator": generator.name,
        "seed": seed,
        **describe(plant),
        "triangles": tree.counts.triangles,
        "levels": level_facts(tree)["levels"],
        "files": {name: str(folder / name) for name in (*tree.names, "picture.png", "preset.yaml", *strips)},
        **({"strip_failed": failed} if strips else {}),
    }
    print(json.dumps(facts, ensure_ascii=False), flush=True)


def _strip(
    cfg: DictConfig, generator: Generator, values: Values, seed: int, asset: AssetSettings
) -> tuple[list[str], list[str]]:
    """Write the growth strip where there is one to show: names of its files, and what is missing in it."""
    settings = read_settings(cfg).strip
    parameter = shown_parameter(generator, settings)
    if parameter is None:
        return [], []
    return write_strip(run_folder(), Growth(generator, parameter, values, seed), settings, asset, _preset(cfg))


def _preset(cfg: DictConfig) -> str | None:
    """Name of the preset, if it has one."""
    return None if cfg.preset is None else Path(cfg.preset).stem.removesuffix("preset")


def describe(plant: Plant) -> dict[str, object]:
    """Counts and sizes of a plant; a stem is a chain of segments of one level."""
    extent = extent_of(plant)
    starts = np.flatnonzero(plant.level[1:] > plant.level[plant.parent[1:]]) + 1
    stems = np.bincount(plant.level[starts], minlength=int(plant.level.max()) + 1)
    stems[0] += 1
    return {
        "vertices": plant.n_vertices, "leaves": plant.n_leaves, "stems_by_level": stems.tolist(),
        "height_m": extent.height, "width_m": extent.width, "trunk_radius_m": float(plant.radius[0]), "cut": plant.cut,
    }  # fmt: skip
