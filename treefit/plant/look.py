"""Look: what a generator says of a plant that no mask sees; for files and pictures only, never for the score."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

LeafShape = Literal[
    "broad", "round", "narrow", "lobed", "needle", "tuft", "frond", "oak", "compound", "scale",
    "sprig", "round_sprig", "lobed_sprig", "oak_sprig",
]  # fmt: skip
"""Outline of a leaf: `lobed` is a maple's, `compound` a feather of leaflets as an ash has.

`tuft` is a twig of needles, `frond` the leaf of a palm, `scale` a spray of a thuja, each in the place of one leaf; so
are sprigs, twigs of a dozen leaves.
"""
LEAF_SHAPES: tuple[str, ...] = get_args(LeafShape)
SPRIGS: Mapping[LeafShape, LeafShape] = {
    "broad": "sprig", "round": "round_sprig", "lobed": "lobed_sprig", "oak": "oak_sprig",
}  # fmt: skip
"""Sprigs by the shape of their leaves."""


@dataclass(frozen=True)
class Look:
    """Section of the trunk and outline of the leaves.

    At the foot of the trunk the radius is that of the plant times 1 + lobe_depth * sin(lobes * angle)
    (Weber and Penn 1995, sec. 4.4).
    """

    lobes: int = 0  # count around the trunk
    lobe_depth: float = 0.0  # share of the radius, in [0, 1)
    leaf_shape: str | None = None  # one of LEAF_SHAPES, None when the generator has no wish


def check_look(look: Look) -> None:
    """Raise ValueError with the first value of `look` that is out of its range."""
    if look.lobes < 0:
        raise ValueError(f"plant: lobes must be 0 or more, got {look.lobes}")
    if not 0 <= look.lobe_depth < 1:
        raise ValueError(f"plant: lobe_depth must be in [0, 1), got {look.lobe_depth}")
    if look.leaf_shape is not None and look.leaf_shape not in LEAF_SHAPES:
        raise ValueError(f"plant: leaf_shape must be one of {', '.join(LEAF_SHAPES)}, got {look.leaf_shape!r}")
