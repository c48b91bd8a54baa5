"""The files of a tree: every level as GLB, all levels in one, and the further formats that the settings name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from treefit.asset.formats.glb import write_models
from treefit.asset.formats.obj import write_obj
from treefit.asset.formats.ply import write_ply
from treefit.asset.formats.skeleton import write_skeleton_json, write_skeleton_npz
from treefit.asset.formats.usd import require_usd, write_usd
from treefit.asset.lod.levels import Level, levels_of
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.model import MeshCounts, Model
from treefit.asset.pictures.picture import check_renderer
from treefit.asset.pictures.turntable import turntable, write_turntable
from treefit.asset.settings import AssetSettings, Format
from treefit.plant import Plant, check_plant

_ALIKE = 0.9
"""Silhouette IoU with the whole model from which a level may stand for it in a small picture."""


@dataclass(frozen=True)
class LevelFile:
    """A level of detail and its file."""

    name: str  # tree_LOD0, of the node in the file
    file: str  # tree.glb, tree_LOD1.glb and so on
    triangles: int
    vertices: int
    silhouette_iou: float  # with the whole model, mean over views; 1 for the whole model


@dataclass(frozen=True)
class TreeFiles:
    """What was written of a tree: the whole model's counts, its levels, and the names of all files."""

    counts: MeshCounts
    levels: tuple[LevelFile, ...]
    names: tuple[str, ...]


def check_possible(settings: AssetSettings) -> None:
    """Raise ValueError when a file or a picture cannot be made on this machine; for before a long search."""
    check_renderer(settings)
    if "usd" in settings.formats:
        require_usd()


def write_tree(folder: Path, plant: Plant, settings: AssetSettings, seen: TreeColours | None = None) -> TreeFiles:
    """Write `plant` to `folder`: tree.glb, tree_LOD1.glb and so on, tree_lods.glb when there are more levels than one.

    Further formats are tree.obj with tree.mtl and textures, tree_skeleton.ply, .json and .npz, and tree.usdz with all
    levels; turntable.webp shows it from all sides. `seen` are colours of a picture. ValueError when the plant has
    nothing to show or holds NaN.
    """
    check_plant(plant)
    check_possible(settings)
    levels = levels_of(plant, settings, seen)
    models = [level.model for level in levels]
    names = ["tree.glb", *(f"{model.name}.glb" for model in models[1:])]
    for name, model in zip(names, models, strict=True):
        write_models([model], folder / name, settings)
    files = tuple(
        LevelFile(level.model.name, name, level.triangles, level.vertices, level.silhouette_iou)
        for name, level in zip(names, levels, strict=True)
    )
    if len(models) > 1:
        names.append("tree_lods.glb")
        write_models(models, folder / names[-1], settings)
    for old in (path for path in folder.glob("tree_*.glb") if path.name not in names):
        old.unlink()  # of a run with more levels
    for kind in dict.fromkeys(settings.formats):
        names += _WRITERS[kind](folder, plant, models)
    if settings.turntable:
        write_turntable(turntable(_quick(levels), settings.turntable), folder / "turntable.webp")
        names.append("turntable.webp")
    return TreeFiles(models[0].counts, files, tuple(names))


def _quick(levels: Sequence[Level]) -> Model:
    """Return the coarsest level that still has the whole model's outline, cards apart: it is drawn the quickest."""
    alike = [level.model for level in levels if level.wanted != "billboard" and level.silhouette_iou >= _ALIKE]
    return alike[-1] if alike else levels[0].model


Writer = Callable[[Path, Plant, Sequence[Model]], list[str]]
"""Writes to a folder, and returns the names of its files."""


def _obj(folder: Path, _: Plant, models: Sequence[Model]) -> list[str]:
    return write_obj(models[0], folder / "tree.obj")


def _usd(folder: Path, _: Plant, models: Sequence[Model]) -> list[str]:
    write_usd(models, folder / "tree.usdz")
    return ["tree.usdz"]


def _skeleton(write: Callable[[Plant, Path], None], suffix: str) -> Writer:
    def written(folder: Path, plant: Plant, _: Sequence[Model]) -> list[str]:
        write(plant, folder / f"tree_skeleton{suffix}")
        return [f"tree_skeleton{suffix}"]

    return written


_WRITERS: Mapping[Format, Writer] = {
    "obj": _obj, "usd": _usd, "ply": _skeleton(write_ply, ".ply"),
    "json": _skeleton(write_skeleton_json, ".json"), "npz": _skeleton(write_skeleton_npz, ".npz"),
}  # fmt: skip
