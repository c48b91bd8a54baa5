"""Paint: the colours of bark and leaves before any light falls on them, and the way between sRGB and linear."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.colour import Colour, to_linear
from treefit.asset.mesh import Mesh
from treefit.plant import Plant

Floats = NDArray[np.float32]


def leaf_colours(plant: Plant, mesh: Mesh, own: Colour) -> Floats:
    """Linear colours (n, 3): each leaf a little lighter or darker, yellower or bluer; fixed by its index."""
    k = plant.n_leaves
    index = np.arange(k, dtype=np.uint64)
    light = _noise(index, 1)
    hue = _noise(index, 2)
    factor = np.column_stack([0.86 + 0.40 * hue, 0.94 + 0.12 * hue, 1.16 - 0.50 * hue]) * (0.76 + 0.5 * light)[:, None]
    colour = to_linear(own) * factor
    return np.asarray(np.repeat(colour, len(mesh.vertices) // k, axis=0), dtype=np.float32)


def bark_colours(mesh: Mesh, own: Colour, tall: float) -> Floats:
    """Linear colours (n, 3): darker at the foot, lighter and a little greyer towards the twigs."""
    up = np.clip(mesh.vertices[:, 2] / tall, 0, 1)[:, None]
    return np.asarray(to_linear(own) * (0.72 + 0.5 * up**0.6), dtype=np.float32)


def _noise(index: NDArray[np.uint64], stream: int) -> NDArray[np.float64]:
    """Numbers (k,) in [0, 1) that depend on the index alone (splitmix64)."""
    z = (index + np.uint64(stream) * np.uint64(0x632BE59BD9B4E019)) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    numbers: NDArray[np.float64] = (z >> np.uint64(11)) / 2.0**53
    return numbers
