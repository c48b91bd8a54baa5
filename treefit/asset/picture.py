"""Picture: a plant in sun and shade as a person would look at it; software only, no display."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from treefit.asset.frame import Frame, frame_plant
from treefit.asset.glb import plant_meshes
from treefit.asset.light import SUN, SunMap, sky_seen, sun_map
from treefit.asset.mesh import Mesh
from treefit.asset.settings import AssetSettings, Colour
from treefit.asset.shade import Surface, shade
from treefit.asset.zbuffer import nearest_triangles
from treefit.plant import Plant

Floats = NDArray[np.float32]
Picture = NDArray[np.uint8]  # (h, w, 3) sRGB

_FINER = 2  # samples a pixel along each side
_TILT = 0.16  # the ground is drawn as seen from a little above, or it would be a line


def picture(plant: Plant, settings: AssetSettings, size: int | tuple[int, int] | None = None) -> Picture:
    """Return a picture (h, w, 3) of `plant` from the front (orthographic, trunk base in the middle column).

    `size` is (h, w), or the height alone when the width shall follow the plant; default settings.picture_size.
    """
    surface = _surface(plant, settings)
    frame = frame_plant(surface.place, size or settings.picture_size).finer(_FINER)
    tall = float(surface.place[:, 2].max())
    screen = frame.project(surface.place)
    seen, _ = nearest_triangles(screen, surface.faces, frame.height, frame.width)
    sun = sun_map(surface.place, surface.faces)
    image = _background(frame, sun, tall)
    shade(surface, screen, seen, sun, 0.008 * tall, image)
    fine = _srgb(_tone(image, seen >= 0))
    h, w = frame.height // _FINER, frame.width // _FINER
    mean = fine.reshape(h, _FINER, w, _FINER, 3).mean(axis=(1, 3))
    return (mean * 255 + 0.5).astype(np.uint8)


def _surface(plant: Plant, settings: AssetSettings) -> Surface:
    meshes = plant_meshes(plant, settings)
    if not meshes:
        raise ValueError("picture: the plant has no stem longer than zero and no leaf, nothing to show")
    tall = max(float(mesh.vertices[:, 2].max()) for mesh in meshes.values())
    parts = list(meshes.items())
    place = np.concatenate([mesh.vertices for _, mesh in parts])
    starts = np.cumsum([0] + [len(mesh.vertices) for _, mesh in parts])
    faces = np.concatenate([mesh.faces + start for (_, mesh), start in zip(parts, starts, strict=False)])
    is_leaf = np.concatenate([np.full(len(mesh.vertices), name == "leaves") for name, mesh in parts])
    normal = np.concatenate([_leaf_normals(mesh) if name == "leaves" else mesh.normals for name, mesh in parts])
    colour = np.concatenate(
        [_leaf_colours(plant, mesh, settings) if name == "leaves" else _bark_colours(mesh, settings, tall) for name, mesh in parts]
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


def _leaf_colours(plant: Plant, mesh: Mesh, settings: AssetSettings) -> Floats:
    """Linear colours (n, 3): each leaf a little lighter or darker, yellower or bluer; fixed by its index."""
    k = plant.n_leaves
    index = np.arange(k, dtype=np.uint64)
    light = _noise(index, 1)
    hue = _noise(index, 2)
    factor = np.column_stack([0.86 + 0.40 * hue, 0.94 + 0.12 * hue, 1.16 - 0.50 * hue]) * (0.76 + 0.5 * light)[:, None]
    colour = _linear(settings.leaf) * factor
    return np.repeat(colour, len(mesh.vertices) // k, axis=0).astype(np.float32)


def _bark_colours(mesh: Mesh, settings: AssetSettings, tall: float) -> Floats:
    """Linear colours (n, 3): darker at the foot, lighter and a little greyer towards the twigs."""
    up = np.clip(mesh.vertices[:, 2] / tall, 0, 1)[:, None]
    return (_linear(settings.bark) * (0.72 + 0.5 * up**0.6)).astype(np.float32)


def _noise(index: NDArray[np.uint64], stream: int) -> NDArray[np.float64]:
    """Numbers (k,) in [0, 1) that depend on the index alone (splitmix64)."""
    z = (index + np.uint64(stream) * np.uint64(0x632BE59BD9B4E019)) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    numbers: NDArray[np.float64] = (z >> np.uint64(11)) / 2.0**53
    return numbers


def _background(frame: Frame, sun: SunMap, tall: float) -> Floats:
    """Linear (h, w, 3): pale sky, pale ground and the plant's shadow on it."""
    h, w = frame.height, frame.width
    rows = (np.arange(h) + 0.5)[:, None, None]
    sky_share = np.clip(rows / frame.base, 0, 1) ** 1.3
    sky = _linear((196, 214, 230)) * (1 - sky_share) + _linear((243, 243, 238)) * sky_share
    ground_share = np.clip((rows - frame.base) / (h - frame.base), 0, 1)
    ground = _linear((216, 214, 198)) * (1 - ground_share) + _linear((199, 197, 178)) * ground_share
    rise = np.clip((rows - frame.base + 0.075 * h) / (0.085 * h), 0, 1)
    rise = rise * rise * (3 - 2 * rise)
    shadow = _ground_shadow(frame, sun, tall)[..., None]
    ground = ground * (1 - shadow * np.array([0.50, 0.47, 0.40]))
    return np.ascontiguousarray(sky * (1 - rise) + ground * rise, dtype=np.float32)


def _ground_shadow(frame: Frame, sun: SunMap, tall: float) -> Floats:
    """Darkness (h, w) in [0, 1] of the ground: the plant's own shadow, softer than the sun would draw it."""
    h, w = frame.height, frame.width
    row, column = np.mgrid[0:h:2, 0:w:2] + 1.0
    x = (column - w / 2) / frame.scale
    y = (frame.base - row) / (frame.scale * _TILT)
    at = sun.project(np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3).astype(np.float32))
    size = sun.depth.shape[0]
    inside = (at[:, :2] >= 0).all(axis=1) & (at[:, :2] < size).all(axis=1)
    cell = np.clip(at[:, :2].astype(np.int64), 0, size - 1)
    dark = inside & np.isfinite(sun.depth[cell[:, 1], cell[:, 0]])
    blocked = Image.fromarray((dark.reshape(x.shape) * 255).astype(np.uint8))
    soft = blocked.filter(ImageFilter.GaussianBlur(0.006 * h)).resize((w, h), Image.Resampling.BILINEAR)
    contact = np.exp(-((np.hypot(x, y) / (0.045 * tall)) ** 2))
    near = Image.fromarray((contact * 160).astype(np.uint8)).resize((w, h), Image.Resampling.BILINEAR)
    return np.maximum(np.asarray(soft), np.asarray(near)).astype(np.float32) / 255


def _tone(image: Floats, on_plant: NDArray[np.bool_]) -> Floats:
    """Return `image` with the plant's brightest parts rolled off; the background keeps its colours."""
    rolled = image * (1 + image / 1.6) / (1 + image)
    return np.where(on_plant[..., None], rolled, image)


def _linear(colour: Colour) -> NDArray[np.float64]:
    """Linear (3,) of an sRGB colour in 0..255, near enough for pictures."""
    return (np.array(colour) / 255.0) ** 2.2


def _srgb(linear: Floats) -> Floats:
    return np.asarray(np.clip(linear, 0, 1) ** np.float32(1 / 2.2), dtype=np.float32)
