"""Picture: a plant in sun and shade as a person would look at it; software only, no display."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.colour import to_srgb
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.mesh import Mesh
from treefit.asset.model import model_of
from treefit.asset.pictures.backdrop import backdrop
from treefit.asset.pictures.frame import TREE_SHARE, Frame, frame_plant
from treefit.asset.pictures.light import sky_seen, sun_map
from treefit.asset.pictures.paint import bark_colours, leaf_colours
from treefit.asset.pictures.shade import Surface, shade
from treefit.asset.pictures.zbuffer import nearest_triangles
from treefit.asset.settings import AssetSettings
from treefit.plant import Plant
from treefit.plant.extent import extent_of

Floats = NDArray[np.float32]
Picture = NDArray[np.uint8]  # (h, w, 3) sRGB

_FINER = 2  # samples a pixel along each side
_THINNEST = 0.3  # radius in pixels


def picture(
    plant: Plant,
    settings: AssetSettings,
    size: int | tuple[int, int] | Frame | None = None,
    seen: TreeColours | None = None,
) -> Picture:
    """Return a picture (h, w, 3) of `plant` from the front (orthographic, trunk base in the middle column).

    `size` is (h, w), or the height alone when the width shall follow the plant; default settings.picture_size.
    A Frame sets the scale too, so that several plants are shown at one.
    """
    size = size or settings.picture_size
    surface = _surface(_thickened(plant, size), settings, seen)
    frame = (size if isinstance(size, Frame) else frame_plant(surface.place, size)).finer(_FINER)
    tall = float(surface.place[:, 2].max())
    screen = frame.project(surface.place)
    nearest, _ = nearest_triangles(screen, surface.faces, frame.height, frame.width)
    sun = sun_map(surface.place, surface.faces)
    image = backdrop(frame, sun, tall)
    shade(surface, screen, nearest, sun, 0.008 * tall, image)
    fine = to_srgb(_tone(image, nearest >= 0))
    h, w = frame.height // _FINER, frame.width // _FINER
    mean = fine.reshape(h, _FINER, w, _FINER, 3).mean(axis=(1, 3))
    return np.asarray(mean * 255 + 0.5, dtype=np.uint8)


def _thickened(plant: Plant, size: int | tuple[int, int] | Frame) -> Plant:
    """Return `plant` with twigs thick enough to be unbroken lines in a picture of that size."""
    if isinstance(size, Frame):
        metres_a_pixel = 1 / size.scale
    else:
        metres_a_pixel = extent_of(plant).height / (TREE_SHARE * (size if isinstance(size, int) else size[0]))
    thinnest = np.float32(_THINNEST * metres_a_pixel)
    return replace(plant, radius=np.maximum(plant.radius, thinnest))


def _surface(plant: Plant, settings: AssetSettings, seen: TreeColours | None) -> Surface:
    model = model_of(plant, settings, seen)
    meshes = {name: part.mesh for name, part in model.parts.items()}
    tall = max(float(mesh.vertices[:, 2].max()) for mesh in meshes.values())
    parts = list(meshes.items())
    place = np.concatenate([mesh.vertices for _, mesh in parts])
    starts = np.cumsum([0] + [len(mesh.vertices) for _, mesh in parts])
    faces = np.concatenate([mesh.faces + start for (_, mesh), start in zip(parts, starts, strict=False)])
    is_leaf = np.concatenate([np.full(len(mesh.vertices), name == "leaves") for name, mesh in parts])
    normal = np.concatenate([_leaf_normals(mesh) if name == "leaves" else mesh.normals for name, mesh in parts])
    colour = np.concatenate(
        [
            leaf_colours(plant, part.mesh, part.material.colour)
            if name == "leaves"
            else bark_colours(part.mesh, part.material.colour, tall)
            for name, part in model.parts.items()
        ]
    )
    grain = np.array([0.006, 0.05], dtype=np.float32) * tall
    uv = np.concatenate([mesh.uv for _, mesh in parts]) / grain
    return Surface(place, faces.astype(np.int32), normal, colour, sky_seen(plant, place), uv, is_leaf)


def _leaf_normals(mesh: Mesh) -> Floats:
    """Normals (n, 3) turned to the viewer and bent outwards, which makes single leaves read as one crown."""
    centre = mesh.vertices.mean(axis=0)
    spread = np.maximum(mesh.vertices.std(axis=0), 1e-6)
    outward = (mesh.vertices - centre) / spread
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-6)
    facing = np.where(mesh.normals[:, 1:2] > 0, -mesh.normals, mesh.normals)
    return np.asarray(0.6 * facing + 0.6 * outward, dtype=np.float32)


def _tone(image: Floats, on_plant: NDArray[np.bool_]) -> Floats:
    """Return `image` with the plant's brightest parts rolled off; the background keeps its colours."""
    rolled = image * (1 + image / 1.6) / (1 + image)
    return np.asarray(np.where(on_plant[..., None], rolled, image), dtype=np.float32)
