"""Environment: light and things around a tree of GEGen, as the user says it and as the kernels take it.

Lengths are in heights of the grown tree (`leader` internodes); the foot of the trunk is at the origin, x runs to the
right, y away from the viewer, z up; the ground is z = 0. What is further than 1.1 heights to a side or higher than 1.4
blocks growth, but casts no shade.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from generators.gegen.surroundings import Thing, numbers, read_box, read_picture
from generators.gegen.voxels import Grid, shade_by_voxel

STEEPEST = 0.7
"""Metres to a side by one of height from which light comes at most."""
FOOT = 0.1
"""Heights around the foot of the trunk that hold no obstacle, so that there is a tree."""

Scene = tuple[NDArray[np.float32], NDArray[np.uint8], NDArray[np.float32], Grid]
"""Boxes (m, 6) and pixels (h, w) of obstacles, extent of the pixels (6,), shade that every voxel adds."""

_SETTINGS = ("light", "boxes", "mask")


@dataclass(frozen=True)
class Environment:
    """Where the light comes from and what stands around the tree; without settings an open field at noon."""

    light: Sequence[float] = (0.0, 0.0, 1.0)  # x y z towards the light
    boxes: Sequence[Mapping[str, object]] = ()  # {from: [x, y, z], to: [x, y, z], solid: true, shade: 10}
    mask: Mapping[str, object] | None = None  # {file, left, right, bottom, top, front, back, solid, shade}

    def __post_init__(self) -> None:
        x, y, z = numbers(self.light, 3, "environment.light")
        if z <= 0 or max(abs(x), abs(y)) > STEEPEST * z * (1 + 1e-6):
            raise ValueError(
                f"environment.light: must come from above: z > 0, x and y at most {STEEPEST} z; got {[x, y, z]}"
            )
        if isinstance(self.boxes, str | Mapping) or not isinstance(self.boxes, Sequence):
            raise ValueError(f"environment.boxes: must be a list, got {self.boxes!r}")
        for place, thing in self.things.items():
            if thing.solid and thing.distance_to_foot() < FOOT:
                raise ValueError(
                    f"{place}: an obstacle must be {FOOT} heights or more from the foot of the trunk at [0, 0, 0]"
                )

    @cached_property
    def things(self) -> Mapping[str, Thing]:
        """What stands around, by its name in messages."""
        places = (f"environment.boxes[{number}]" for number in range(len(self.boxes)))
        things = {place: read_box(box, place) for place, box in zip(places, self.boxes, strict=True)}
        if self.mask is not None:
            things["environment.mask"] = read_picture(self.mask, "environment.mask")
        return things

    @cached_property
    def slope(self) -> tuple[float, float]:
        """Metres to the right and to the back that the light comes from by one of height."""
        x, y, z = self.light
        return x / z, y / z

    @cached_property
    def scene(self) -> Scene:
        """What the kernels take."""
        solid = [thing for thing in self.things.values() if thing.solid]
        boxes = np.array([thing.corners for thing in solid if thing.pixels is None], np.float32).reshape(-1, 6)
        pixels, extent = np.zeros((0, 0), np.uint8), np.zeros(6, np.float32)
        for thing in solid:
            if thing.pixels is not None:
                pixels, extent = thing.pixels, np.array(thing.corners, np.float32)
        return boxes, pixels, extent, shade_by_voxel(tuple(self.things.values()))


def environment_of(given: Environment | Mapping[str, Any] | None) -> Environment:
    """Environment that was given, or that settings by name describe."""
    if given is None or isinstance(given, Environment):
        return given or Environment()
    if not isinstance(given, Mapping):
        raise ValueError(f"environment: must be null or have {', '.join(_SETTINGS)}; got {given!r}")
    for name in given:
        if name not in _SETTINGS:
            raise ValueError(f"environment.{name}: no such setting; there are {', '.join(_SETTINGS)}")
    return Environment(**given)
