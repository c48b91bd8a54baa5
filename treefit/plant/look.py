"""Look: what a generator says of a plant that no mask sees; for files and pictures only, never for the score."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

LeafShape = Literal["broad", "round", "narrow", "lobed", "needle", "tuft", "frond"]
"""Outline of a leaf; `tuft` is a twig of needles, `frond` a feather leaf, each in the place of one leaf."""
LEAF_SHAPES: tuple[str, ...] = get_args(LeafShape)


@dataclass(frozen=True)
class Look:
    """Section of the trunk and outline of the leaves.

    At the foot of the trunk the radius is that of the plant times 1 + lobe_depth * sin(lobes * angle)
    (Weber and Penn 1995, sec. 4.4).
    """

    lobes: int = 0  # count around the trunk
    lobe_depth: float = 0.0  # share of the radius, in [0, 1)
    leaf_shape: str | None = None  # one of LEAF_SHAPES, None when the generator has no wish


def leaf_shape_of(wanted: str, look: Look | None) -> str:
    """Return the leaf shape that is `wanted`; "auto" is that of the look, "broad" when it has none."""
    if wanted != "auto":
        return wanted
    return "broad" if look is None or look.leaf_shape is None else look.leaf_shape


def check_look(look: Look) -> None:
    """Raise ValueError with the first value of `look` that is out of its range."""
    if look.lobes < 0:
        raise ValueError(f"plant: lobes must be 0 or more, got {look.lobes}")
    if not 0 <= look.lobe_depth < 1:
        raise ValueError(f"plant: lobe_depth must be in [0, 1), got {look.lobe_depth}")
    if look.leaf_shape is not None and look.leaf_shape not in LEAF_SHAPES:
        raise ValueError(f"plant: leaf_shape must be one of {', '.join(LEAF_SHAPES)}, got {look.leaf_shape!r}")
