"""Meshes of which the skeleton is known."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

SIDES = 7
INNER = SIDES / np.pi * np.sin(np.pi / SIDES)
"""Mean width of a regular polygon with so many sides by that of its circle."""


def tube(axis: ArrayLike, radius: ArrayLike, end: str = "open", sides: int = SIDES) -> trimesh.Trimesh:
    """Rings of corners around the points (n, 3) of an axis, joined by long triangles.

    Its ends are open, flat ("cap"), have a tip on each ("tip"), or all of its triangles are loose ("soup"); a "seam"
    has its corners twice.
    """
    points = np.asarray(axis, float)
    radii = np.broadcast_to(radius, len(points))
    along = np.gradient(points, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    side = np.cross(along, [0.3, 0.9, 0.31])
    side /= np.linalg.norm(side, axis=1)[:, None]
    columns = sides + 1 if end == "seam" else sides
    turn = 2 * np.pi * np.arange(columns) / sides
    rim = np.cos(turn)[:, None] * side[:, None] + np.sin(turn)[:, None] * np.cross(along, side)[:, None]
    corners = (points[:, None] + radii[:, None, None] * rim).reshape(-1, 3)
    ring, step = np.meshgrid(np.arange(len(points) - 1), np.arange(sides), indexing="ij")
    a, b = ring * columns + step, ring * columns + (step + 1) % columns
    quads = np.stack([a, b, b + columns, a + columns], axis=-1).reshape(-1, 4)
    faces = [*quads[:, [0, 1, 2]], *quads[:, [0, 2, 3]]]
    last = (len(points) - 1) * columns
    if end == "cap":
        faces += [[0, i + 1, i] for i in range(1, sides - 1)]
        faces += [[last, last + i, last + i + 1] for i in range(1, sides - 1)]
    if end == "tip":
        tips = [points[0] - radii[0] * along[0], points[-1] + radii[-1] * along[-1]]
        corners = np.concatenate([corners, tips])
        faces += [[len(corners) - 2, (i + 1) % sides, i] for i in range(sides)]
        faces += [[len(corners) - 1, last + i, last + (i + 1) % sides] for i in range(sides)]
    if end == "soup":
        corners = corners[np.array(faces)].reshape(-1, 3)
        faces = list(np.arange(len(corners)).reshape(-1, 3))
    return trimesh.Trimesh(corners, np.array(faces), process=False)


def pole(height: float = 2.0, radius: float = 0.1) -> trimesh.Trimesh:
    """An upright trunk of four rings."""
    return tube(np.linspace([0, 0, 0], [0, 0, height], 4), radius)


def card(foot: ArrayLike, along: ArrayLike, across: ArrayLike) -> trimesh.Trimesh:
    """A rectangle of two triangles from the middle of its foot."""
    foot, along, across = np.asarray(foot, float), np.asarray(along, float), np.asarray(across, float)
    corners = [foot - across / 2, foot + across / 2, foot + along + across / 2, foot + along - across / 2]
    return trimesh.Trimesh(corners, [[0, 1, 2], [0, 2, 3]], process=False)


def joined(meshes: list[trimesh.Trimesh]) -> trimesh.Trimesh:
    """One mesh of several, nothing merged."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts[:-1], strict=True)]
    return trimesh.Trimesh(np.concatenate([m.vertices for m in meshes]), np.concatenate(faces), process=False)


def scene(materials: bool = True, **parts: trimesh.Trimesh | tuple[trimesh.Trimesh, str]) -> trimesh.Scene:
    """Scene with objects and materials of the names of `parts`; a mesh may come with its alpha mode."""
    made = trimesh.Scene()
    for name, part in parts.items():
        mesh, alpha = part if isinstance(part, tuple) else (part, "OPAQUE")
        look = PBRMaterial(name=name if materials else "", alphaMode=alpha)
        mesh.visual = TextureVisuals(np.zeros((len(mesh.vertices), 2)), material=look)
        made.add_geometry(mesh, node_name=name, geom_name=name)
    return made


def bend(count: int = 12, height: float = 3.0) -> NDArray[np.float64]:
    """Points (count, 3) of an axis that bends over."""
    t = np.linspace(0, 1, count)
    return np.column_stack([0.8 * t**2, 0.2 * np.sin(3 * t), height * t])
