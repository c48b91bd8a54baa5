"""Parts: what a scene of trimesh holds, each piece of it with its names, z upwards."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import trimesh

FARTHEST = 1e5
"""Extent of a tree in metres, at most."""


@dataclass(frozen=True, eq=False)
class Part:
    """Triangles with one material."""

    places: NDArray[np.float64]  # (v, 3) m, z up
    triangles: NDArray[np.int32]  # (t, 3)
    names: tuple[str, ...]  # of its material, of its object
    see_through: bool  # its material is cut out or blended


Parts: TypeAlias = Sequence[Part]


def parts_of(scene: trimesh.Scene | trimesh.Trimesh, up: str) -> list[Part]:
    """Return the meshes of `scene` where its graph puts them; ValueError when there is no triangle, or a NaN."""
    if up not in ("y", "z"):
        raise ValueError(f"mesh: up must be y or z, got {up!r}")
    parts = [part for part in _found(scene, up) if len(part.triangles)]
    if not parts:
        raise ValueError("mesh: has no triangles")
    for part in parts:
        count, name = len(part.places), part.names[-1]
        if part.triangles.min() < 0 or part.triangles.max() >= count:
            raise ValueError(f"mesh: {name!r} has {count} vertices and triangles with others")
        if not np.isfinite(part.places).all():
            raise ValueError(f"mesh: {name!r} has vertices that are NaN or infinite")
        if np.abs(part.places).max() > FARTHEST:
            raise ValueError(f"mesh: {name!r} reaches {np.abs(part.places).max():.3g} m, over {FARTHEST:g}")
    return parts


def _found(scene: trimesh.Scene | trimesh.Trimesh, up: str) -> Iterator[Part]:
    import trimesh

    if isinstance(scene, trimesh.Trimesh):
        yield _part(scene, np.eye(4), ("mesh",), up)
        return
    for node in scene.graph.nodes_geometry:
        place, name = scene.graph[node]
        mesh = scene.geometry[name]
        if isinstance(mesh, trimesh.Trimesh):  # not lines, not points
            yield _part(mesh, np.asarray(place), (str(node), str(name)), up)


def _part(mesh: trimesh.Trimesh, place: NDArray[np.float64], names: tuple[str, ...], up: str) -> Part:
    material = getattr(mesh.visual, "material", None)
    called = getattr(material, "name", None)
    places = np.asarray(mesh.vertices, dtype=np.float64)
    with np.errstate(all="ignore"):  # what is not finite is told later
        if not np.array_equal(place, np.eye(4)):
            places = places @ place[:3, :3].T + place[:3, 3]
        if up == "y":
            places = places[:, [0, 2, 1]] * (1.0, -1.0, 1.0)
    return Part(
        np.ascontiguousarray(places), np.ascontiguousarray(mesh.faces, dtype=np.int32),
        (str(called or ""), *names), getattr(material, "alphaMode", None) in ("MASK", "BLEND"),
    )  # fmt: skip
