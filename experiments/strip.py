"""Growth strip of the task grow: the same tree in several years of its life, or along another parameter."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from experiments.settings import Strip
from experiments.sheet_values import written
from experiments.strip_animation import write_animation
from experiments.strip_growth import Growth
from experiments.strip_page import Moment, strip_page
from treefit.asset import AssetSettings
from treefit.plant import Value
from treefit.plant.extent import extent_of

FRAMES, STEPS = 8, 24
"""Pictures of a strip when nobody says how many, and of an animation along what are no years."""


def write_strip(
    folder: Path, growth: Growth, settings: Strip, asset: AssetSettings, preset: str | None
) -> tuple[list[str], list[str]]:
    """Write strip.png and growth.webp as far as wanted; names of the files, and what failed with its reason."""
    frames = FRAMES if settings.frames is None else settings.frames
    strip = moments(growth, growth.spaced(frames)) if frames else []
    names = []
    if strip:
        title, legend = _words(growth, preset)
        strip_page(strip, settings, asset, title, legend).save(folder / "strip.png")
        names.append("strip.png")
    film: list[Moment] = []
    if settings.animation:
        film = moments(growth, growth.spaced(round(growth.ends()[1]) if growth.by_year else STEPS))
        names += ["growth.webp"] if write_animation(folder / "growth.webp", film, asset) else []
    failures = [f"{moment.name}: {moment.plant}" for moment in [*strip, *film] if isinstance(moment.plant, str)]
    return names, list(dict.fromkeys(failures))


def moments(growth: Growth, values: Sequence[float]) -> list[Moment]:
    """The plant at `values`, each with its caption."""
    return [_moment(growth, value) for value in values]


def _moment(growth: Growth, value: float) -> Moment:
    parameter, plant = growth.parameter, growth.at(value)
    told: Value = int(value) if parameter.kind == "int" else value
    name = f"year {told}" if growth.by_year else written(told, parameter.unit)
    if isinstance(plant, str):
        return Moment(plant, name, ())
    height = extent_of(plant).height
    shown = f"{height:,.1f} m" if height >= 1 else f"{height:.2f} m"
    return Moment(plant, name, (shown, f"{plant.n_vertices:,} vertices", f"{plant.n_leaves:,} leaves"))


def _words(growth: Growth, preset: str | None) -> tuple[str, str]:
    """Title and legend of the strip."""
    generator, (first, last) = growth.generator, growth.ends()
    subject = "growth" if growth.by_year else growth.parameter.name
    title = f"{generator.name} {generator.version}: {subject}{f' of {preset}' if preset else ''}, seed {growth.seed}"
    if not growth.by_year:
        return title, f"The same tree, but for its {subject}: {growth.parameter.doc}. All at one scale."
    legend = f"The same tree after {first:.0f} to {last:.0f} years, all at one scale."
    return title, legend + (f" Grown up by then, it is the same at {growth.own:.0f}." if last < growth.own else "")
