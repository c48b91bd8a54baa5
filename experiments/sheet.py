"""Task sheet: what each parameter of a generator does, and its presets, as pages of small pictures."""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import cast

from omegaconf import DictConfig
from PIL import Image

from experiments.build import build
from experiments.numbers import rounded
from experiments.preset import wanted_plant
from experiments.run_folder import run_folder
from experiments.settings import Sheet, read_settings
from experiments.sheet_cells import Drawing, grow
from experiments.sheet_parameters import MASK_SHARE, Row, parameter_pages
from experiments.sheet_presets import Block, preset_pages
from experiments.sheet_shown import Stage, first_shown, stages
from experiments.sheet_values import choose, steps, written
from experiments.terminal import counted
from treefit.asset import AssetSettings
from treefit.plant import Generator, Parameter, Plant, Value
from treefit.plant.extent import extent_of

PARAMETER_LEGEND = (
    "A row is one parameter from its lowest to its highest value, all others at {source}, on seed {seed}; what shows "
    "nothing there is drawn on the preset that its row names. All plants of a row are at one scale; the dot is at the "
    "plant's own value, or nearest to it."
)
PRESET_LEGEND = "Each preset at its own scale, its plants on the same seeds."

_log = logging.getLogger(__name__)


def run(cfg: DictConfig) -> None:
    """Write parameters.png (or parameters_1.png ...) and presets.png of cfg.generator; print one JSON line last.

    What fails to grow is an empty cell with the reason; `unseen` are the parameters that change no pixel,
    on no preset either.
    """
    started, folder, settings = time.perf_counter(), run_folder(), read_settings(cfg)
    generator = cast(Generator, build(cfg.generator, "generator"))
    asset = cast(AssetSettings, build(cfg.asset, "asset"))
    usual, seed, _ = wanted_plant(cfg, generator)
    beside, under = _drawings(asset, settings.sheet)
    rows = parameter_rows(generator, beside, settings.sheet.names, usual, seed)
    source = f"those of {Path(cfg.preset).stem}" if cfg.preset else "their defaults"
    legend = PARAMETER_LEGEND.format(source=source, seed=seed)
    title = f"{generator.name} {generator.version}: "
    files = _save(folder, "parameters", parameter_pages(rows, beside.sizes, f"{title}parameters", legend))
    seeds = range(settings.seed, settings.seed + settings.sheet.seeds)
    blocks = preset_blocks(generator, under, seeds) if seeds else []
    if blocks:
        files += _save(folder, "presets", preset_pages(blocks, under.sizes, f"{title}presets", PRESET_LEGEND))
    elif seeds:
        _log.info("%s has no presets, presets.png is left out", generator.name)
    facts = {
        "generator": generator.name, "version": generator.version, "seed": seed, "files": files,
        "unseen": [row.parameter.name for row in rows if row.unseen], "failed": list(_failures(rows, blocks)),
        "seconds": time.perf_counter() - started,
    }  # fmt: skip
    print(json.dumps(rounded(facts), ensure_ascii=False), flush=True)


def _drawings(asset: AssetSettings, sheet: Sheet) -> tuple[Drawing, Drawing]:
    """How cells are drawn: with a small mask beside the picture, and with one of its size."""
    small = round(sheet.height * MASK_SHARE) if sheet.look == "both" else sheet.height
    return Drawing(asset, sheet.look, sheet.height, small), Drawing(asset, sheet.look, sheet.height, sheet.height)


def parameter_rows(
    generator: Generator, drawing: Drawing, names: Sequence[str] | None, usual: Mapping[str, Value], seed: int
) -> list[Row]:
    """A row for each parameter of `names`, all when None: plants that differ from the `usual` values in it alone.

    One that changes no pixel is shown on the first preset on which it does.
    """

    def row(parameter: Parameter, values: Mapping[str, Value], on: str = "") -> Row:
        shown = steps(parameter)
        plants = [grow(generator, {**values, parameter.name: value}, seed) for value in shown]
        fixed = parameter.name in generator.space.fixed
        return Row(parameter, values[parameter.name], fixed, shown, drawing.row(plants), on)

    rows: list[Row] = []
    ready: list[Stage] | None = None
    for parameter in counted(choose(generator.space, names), "parameters"):
        rows.append(row(parameter, usual))
        if rows[-1].unseen:
            ready = stages(generator, seed) if ready is None else ready
            stage = first_shown(generator, parameter, rows[-1].values, ready, seed)
            rows[-1] = row(parameter, stage.values, stage.name) if stage else rows[-1]
    return rows


def preset_blocks(generator: Generator, drawing: Drawing, seeds: Sequence[int]) -> list[Block]:
    """A block for each preset of `generator`: its plants on `seeds`."""

    def block(name: str) -> Block:
        values = generator.space.complete(generator.presets[name].values)
        plants = [grow(generator, values, each) for each in seeds]
        captions = [_caption(plant, each) for plant, each in zip(plants, seeds, strict=True)]
        return Block(name, drawing.row(plants), captions)

    return [block(name) for name in counted(list(generator.presets), "presets")]


def _caption(plant: Plant | str, seed: int) -> Sequence[str]:
    if isinstance(plant, str):
        return (f"seed {seed}",)
    counts = f"{plant.n_vertices:,} vertices", f"{plant.n_leaves:,} leaves"
    return (f"seed {seed} · {written(extent_of(plant).height, 'm')}", *counts)


def _save(folder: Path, name: str, pages: Sequence[Image.Image]) -> list[str]:
    """Write `name`.png, or `name`_1.png and so on when there are more; return the files."""
    files = [folder / (f"{name}_{i + 1}.png" if len(pages) > 1 else f"{name}.png") for i in range(len(pages))]
    for file, page in zip(files, pages, strict=True):
        page.save(file)
    return [str(file) for file in files]


def _failures(rows: Sequence[Row], blocks: Sequence[Block]) -> Iterator[str]:
    """Say which cells are empty, and why."""
    for row in rows:
        for value, cell in zip(row.values, row.cells, strict=True):
            if cell.failure:
                yield f"{row.parameter.name}={value}: {cell.failure}"
    for block in blocks:
        for caption, cell in zip(block.captions, block.cells, strict=True):
            if cell.failure:
                yield f"{block.name}, {caption[0]}: {cell.failure}"
