"""WeberPennGen beside two other programs of the same model, on seeds that neither ran: see weberpenn_reference.yaml."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from generators.weberpenn import WeberPennGen
from generators.weberpenn.parameters import FULL
from scripts.census import Census, begins, census
from treefit.plant import Budget, Plant, Value
from treefit.plant.preset import read_preset

ROOT = Path(__file__).parents[2]
REFERENCE: dict[str, Any] = yaml.safe_load(Path(__file__).with_name("weberpenn_reference.yaml").read_text())["species"]
SEEDS = {"quaking_aspen": 10, "black_tupelo": 6, "weeping_willow": 3, "black_oak": 6}
TOOLS = ("arbaro", "tree_gen")
NO_SPLITS: dict[str, Value] = {"base_splits": 0, **{f"seg_splits_{n}": 0.0 for n in range(4)}}
WITHOUT_SPLITS = ("quaking_aspen", "black_tupelo")


def values_of(species: str, **other: Value) -> dict[str, Value]:
    """Values of the paper, but for those that differ in the file that the other programs ran."""
    preset = read_preset(ROOT / "generators/weberpenn/species" / f"{species}.yaml")
    return FULL.complete({**preset.values, **REFERENCE[species]["differ"], **other})


def grow(species: str, seed: int, **other: Value) -> Plant:
    plant = WeberPennGen()(values_of(species, **other), seed, Budget(300_000, 600_000))
    assert not plant.cut
    return plant


@cache
def counted(species: str, splits: bool) -> list[Census]:
    flare = float(values_of(species)["flare"])
    other = {} if splits else NO_SPLITS
    return [census(grow(species, 101 + i, **other), flare) for i in range(SEEDS[species])]


def mean(species: str, what: str, splits: bool = True) -> Any:
    return np.mean([getattr(each, what) for each in counted(species, splits)], axis=0)


def ratio(species: str, what: str) -> Any:
    """Mean over the seeds of lengths or radii by those of the trunk, so that the size of the trees does not matter."""
    return np.mean([getattr(each, what) / getattr(each, what)[0] for each in counted(species, True)], axis=0)


@pytest.mark.parametrize("species", SEEDS)
def test_the_trunk_has_the_radius_of_the_paper_and_its_foot_the_flare(species: str) -> None:
    values = values_of(species, scale_v_0=0.0, **NO_SPLITS)
    plant = grow(species, 104, scale_v_0=0.0, **NO_SPLITS)
    trunk = plant.position[plant.level == 0]
    length = np.linalg.norm(np.diff(trunk, axis=0), axis=1).sum()
    radius = length * float(values["ratio"]) * float(values["scale_0"])
    assert plant.radius[0] == pytest.approx(radius * (1 + 0.99 * float(values["flare"])), rel=1e-4)


@pytest.mark.parametrize("tool", TOOLS)
@pytest.mark.parametrize("species", SEEDS)
def test_stems_by_level_without_splits_are_those_of_both_programs(species: str, tool: str) -> None:
    other = REFERENCE[species][tool]
    wanted, stems = other.get("splits_off", other["stems"]), mean(species, "stems", splits=False)
    assert len(stems) == len(wanted)
    assert stems[1] == pytest.approx(wanted[1], rel=0.03, abs=1)  # a stem of 24 is more than 3 %
    assert stems[2] == pytest.approx(wanted[2], rel=0.08)
    assert stems[3:] == pytest.approx(wanted[3:], rel=0.10)


@pytest.mark.parametrize("species", SEEDS)
def test_clones_are_no_stems(species: str) -> None:
    """As in Arbaro; in tree-gen every clone of the trunk has branches_1 children of its own."""
    wanted = REFERENCE[species]["arbaro"]["stems"]
    assert mean(species, "stems") == pytest.approx(wanted, rel=0.04)
    assert mean(species, "stems") == pytest.approx(mean(species, "stems", splits=False), rel=0.04)


@pytest.mark.parametrize(("species", "level"), [("black_oak", 1), ("black_oak", 2), ("weeping_willow", 2)])
def test_every_segment_but_the_last_has_the_mean_count_of_clones(species: str, level: int) -> None:
    values = values_of(species)
    per_stem = (1 + float(values[f"seg_splits_{level}"])) ** (float(values[f"curve_res_{level}"]) - 1) - 1
    clones, stems = mean(species, "clones")[level], mean(species, "stems")[level]
    assert clones / stems == pytest.approx(per_stem, rel=0.06)


@pytest.mark.parametrize("species", WITHOUT_SPLITS)
@pytest.mark.parametrize(("what", "name"), [("length", "length_ratio"), ("radius", "radius_ratio")])
def test_lengths_and_radii_by_those_of_the_trunk_are_those_of_both_programs(species: str, what: str, name: str) -> None:
    """Within what length_v and the last digit leave to Arbaro, which has the paper's 0.6 of the offset.

    tree-gen has 0.7: stems of level 2, half way out in the mean, come out 7 % shorter, those of level 3 twice that.
    """
    measured = ratio(species, what)
    assert measured == pytest.approx(REFERENCE[species]["arbaro"][name], rel=0.015)
    assert measured[:3] == pytest.approx(REFERENCE[species]["tree_gen"][name][:3], rel=0.10)


@pytest.mark.parametrize("tool", TOOLS)
@pytest.mark.parametrize("species", WITHOUT_SPLITS)
def test_trees_are_as_high_as_those_of_both_programs(species: str, tool: str) -> None:
    """By the length of the trunk, whose scale_v would hide all else; the programs themselves are 2 and 3 % apart."""
    other = REFERENCE[species][tool]
    measured = np.mean([each.height / each.length[0] for each in counted(species, True)])
    assert measured == pytest.approx(other["height"] / other["trunk_length"], rel=0.04)


@pytest.mark.parametrize("species", WITHOUT_SPLITS)
def test_every_stem_has_a_vertex_more_than_segments(species: str) -> None:
    values, plant = values_of(species), grow(species, 101)
    trunk = int((plant.level == 0).sum())
    stems = np.bincount(plant.level[begins(plant)])
    nodes = [stems[n] * (int(values[f"curve_res_{n}"]) + 1) for n in range(1, len(stems))]
    assert plant.n_vertices == trunk + sum(nodes)
    assert 0 <= trunk - (int(values["curve_res_0"]) + 1) <= 4  # those of the flare
    assert plant.n_vertices == pytest.approx(REFERENCE[species]["arbaro"]["nodes"], rel=0.01)


def test_branches_and_leaves_of_the_aspen_are_those_of_the_formulas() -> None:
    """Sec. 4.3 and 4.6: stems rounded down, leaves to the mean, children in the middles of equal parts of a parent."""
    at = (np.arange(50) + 0.5) / 50
    left = 1 - at
    fill = 0.5 + 0.5 * np.where(left <= 0.7, left / 0.7, (1 - left) / 0.3)  # ShapeRatio(7)
    twigs = np.floor(30 * (0.2 + 0.8 * fill)).astype(int)
    leaves = sum((25 * (0.5 + 0.5 * (np.arange(n) + 0.5) / n)).sum() for n in twigs)  # ShapeRatio(4)
    assert mean("quaking_aspen", "stems") == pytest.approx([1, 50, twigs.sum()])
    assert twigs.sum() == pytest.approx(1175, abs=3)  # the integral of the formula, rounded down
    assert mean("quaking_aspen", "leaves") == pytest.approx(leaves, rel=0.002)
