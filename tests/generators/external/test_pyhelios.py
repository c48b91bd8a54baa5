"""PyHelios as a generator; skipped where the package, or a library that it needs, is not installed."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray

import generators.external.pyhelios as adapter
from generators.external.arrays import plant_of
from generators.external.space import read_space
from treefit.plant import Plant, Value, Values, read_presets
from treefit.plant.extent import extent_of
from treefit.view import Frame, OrthographicView

pytestmark = pytest.mark.slow  # an extra

HOME = Path(adapter.__file__).parent
SPACE = read_space(HOME / "space.yaml")
PRESETS = read_presets(HOME / "presets")
_THERE = adapter.installed() and not adapter.lacking_libraries()
needs_package = pytest.mark.skipif(not _THERE, reason=f"needs the package {adapter.PACKAGE} and what it needs")
SMALL: dict[str, Value] = {"nBranches.1": 16, "nBranches.2": 8, "Leaves": 8}
SIDES = 12

Arrays = Mapping[str, NDArray[np.float32] | NDArray[np.int32]]


def part(name: str) -> Any:
    """Module of the adapter that imports the package."""
    return import_module(f"generators.external.pyhelios.{name}")


def grow(values: Values, seed: int) -> Arrays:
    """Arrays of a tree, grown in this process."""
    arrays: Arrays = part("program").grow(values, seed)
    return arrays


def digest(values: Values, seed: int) -> str:
    """Digest of all bytes of a tree."""
    return hashlib.sha256(b"".join(np.ascontiguousarray(a).tobytes() for a in grow(values, seed).values())).hexdigest()


def random_values(count: int) -> list[dict[str, Value]]:
    """Values of `count` random genomes."""
    rng = np.random.default_rng(4)
    return [SPACE.decode(rng.random(len(SPACE))) for _ in range(count)]


@needs_package
def test_same_seed_is_the_same_bytes_and_another_seed_another_tree() -> None:
    small = SPACE.complete(SMALL)
    assert digest(small, 5) == digest(small, 5)
    assert len({digest(small, seed) for seed in (0, 1, 2, 5, 3 << 40, 2**63 - 1)}) == 6


@needs_package
def test_another_process_grows_the_same_bytes() -> None:
    values = SPACE.complete(SMALL)
    code = "from generators.external.pyhelios.program import grow; import hashlib, numpy as np; "
    code += f"grown = grow({values}, 7).values(); "
    code += "print(hashlib.sha256(b''.join(np.ascontiguousarray(a).tobytes() for a in grown)).hexdigest())"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.split()[-1] == digest(values, 7)


@needs_package
def test_random_genomes_are_trees_of_a_sensible_size() -> None:
    plants = [plant_of(grow(values, seed)) for seed, values in enumerate(random_values(20))]  # checks each of them
    assert all(200 < plant.n_vertices < 20_000 for plant in plants)
    assert all(50 < plant.n_leaves < 50_000 for plant in plants)


@needs_package
@pytest.mark.parametrize("name", ["lemon", "pistachio"])
def test_presets_grow(name: str) -> None:
    plant = plant_of(grow(SPACE.complete(PRESETS[name].values), PRESETS[name].seed))
    assert 5000 < plant.n_vertices < 10_000
    assert 10_000 < plant.n_leaves < 20_000


@needs_package
def test_stems_stand_on_the_axes_of_their_parents_one_level_up() -> None:
    for seed, values in enumerate(random_values(4)):
        plant = plant_of(grow(values, seed))
        feet = np.flatnonzero(plant.level[1:] > plant.level[plant.parent[1:]]) + 1
        assert np.array_equal(plant.level[feet], plant.level[plant.parent[feet]] + 1)
        assert off_axis(plant, feet).max() < 1e-4 * extent_of(plant).height


@needs_package
@pytest.mark.parametrize("level", [0, 1])
def test_stems_that_follow_a_fork_keep_its_level(level: int) -> None:
    chosen: dict[str, Value] = {**SMALL, "BaseSplits": 1, f"nSegSplits.{level}": 1, "nCurveRes.0": 3, "nCurveRes.1": 3}
    plant = plant_of(grow(SPACE.complete(chosen), 3))
    own = (plant.level[1:] == level) & (plant.level[plant.parent[1:]] == level)
    forks = np.bincount(np.bincount(plant.parent[1:][own]))
    limbs, stems = 2, int((plant.level[1:] > plant.level[plant.parent[1:]])[plant.level[1:] == 1].sum())
    assert forks[2] == (1 + limbs * 3 if level == 0 else stems * 3)  # a stem of three pieces forks in three places
    assert len(forks) == 3


@needs_package
def test_skeleton_and_leaves_cover_what_the_primitives_do() -> None:
    for seed, chosen in enumerate(random_values(3)):
        values = {**chosen, **SMALL}
        plant = plant_of(grow(values, seed))
        bare = replace(plant, **{name: getattr(plant, name)[:0] for name in vars(plant) if name.startswith("leaf_")})
        for shown, leafy in ((plant, True), (bare, False)):
            frame = Frame(256, 12)
            mask = OrthographicView()(shown, frame).unpack() > 0
            direct = drawn(values, seed, leafy, frame, extent_of(shown).height)
            assert (mask & direct).sum() / (mask | direct).sum() > 0.94


@needs_package
def test_a_scene_has_the_named_parts_and_the_size_of_the_tree() -> None:
    values = SPACE.complete(SMALL)
    scene, plant = part("program").scene(values, 2), plant_of(grow(values, 2))
    assert set(scene.geometry) == {"trunk", "branch", "leaf"}
    assert len(scene.geometry["leaf"].faces) == 2 * plant.n_leaves
    wood = np.concatenate([scene.geometry[name].vertices for name in ("trunk", "branch")])
    assert wood.max(axis=0) == pytest.approx(plant.position.max(axis=0), abs=0.1)


@needs_package
def test_an_unknown_name_is_told() -> None:
    with pytest.raises(ValueError, match=r"pyhelios: no parameter 'nCurve\.4'"):
        part("primitives").parameters_of({"nCurve.4": 1.0})


def test_without_the_package_the_factory_tells_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "installed", lambda: False)
    with pytest.raises(ValueError, match=r"install it by: pip install"):
        adapter.pyhelios()


def test_presets_have_the_names_of_the_space() -> None:
    assert len(PRESETS) == 9
    for preset in PRESETS.values():
        assert set(SPACE.complete(preset.values)) == set(preset.values)


def off_axis(plant: Plant, feet: NDArray[np.int64]) -> NDArray[np.float64]:
    """Distance in m of each foot to the nearest segment that begins or ends at its parent."""
    found = np.full(len(feet), np.inf)
    for k, foot in enumerate(feet):
        here = plant.parent[foot]
        stem = np.flatnonzero((plant.parent == here) & (plant.level == plant.level[here]))
        for end in [*stem, here]:
            start = plant.position[plant.parent[end] if plant.parent[end] >= 0 else end].astype(float)
            step = plant.position[end] - start
            share = np.clip((plant.position[foot] - start) @ step / max(step @ step, 1e-12), 0, 1)
            found[k] = min(found[k], np.linalg.norm(start + share * step - plant.position[foot]))
    return found


def drawn(values: Values, seed: int, leafy: bool, frame: Frame, height: float) -> NDArray[np.bool_]:
    """Pixels (frame.height, frame.width) whose centre a triangle of the tree covers, its leaves as ellipses."""
    made = part("primitives").build(values, seed, SIDES)
    trunk = made.trunk if int(values["BaseSplits"]) else made.trunk[: -2 * SIDES]
    triangles = [trunk, made.branches]
    if leafy:
        quads = made.leaves
        centre, turn = quads.mean(axis=1)[:, None], np.linspace(0, 2 * np.pi, 13)[None, :, None]
        half = [(quads[:, corner] - quads[:, 0])[:, None] / 2 for corner in (1, 3)]
        rim = centre + np.cos(turn) * half[0] + np.sin(turn) * half[1]
        fans = np.stack([np.broadcast_to(centre, rim[:, 1:].shape), rim[:, :-1], rim[:, 1:]], axis=2)
        triangles.append(fans.reshape(-1, 3, 3))
    points = np.concatenate(triangles)
    columns, rows = (points[..., 0] / height + frame.half_width) * frame.height, (1 - points[..., 2] / height)
    pixels = np.zeros((frame.height, frame.width), np.bool_)
    _fill(pixels, np.stack([columns, rows * frame.height], axis=-1).astype(np.float64))
    return pixels


@njit(cache=True)
def _fill(pixels, triangles):  # type: ignore[no-untyped-def]
    for t in range(len(triangles)):
        (ax, ay), (bx, by), (cx, cy) = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        for y in range(max(int(min(ay, by, cy)), 0), min(int(max(ay, by, cy)) + 1, pixels.shape[0])):
            for x in range(max(int(min(ax, bx, cx)), 0), min(int(max(ax, bx, cx)) + 1, pixels.shape[1])):
                px, py = x + 0.5, y + 0.5
                a = (bx - ax) * (py - ay) - (by - ay) * (px - ax)
                b = (cx - bx) * (py - by) - (cy - by) * (px - bx)
                c = (ax - cx) * (py - cy) - (ay - cy) * (px - cx)
                if (a >= 0 and b >= 0 and c >= 0) or (a <= 0 and b <= 0 and c <= 0):
                    pixels[y, x] = True
