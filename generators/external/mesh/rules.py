"""Mesh: the user's rules of how a mesh is read: what is leaf, what is wood, in which unit its complexity is told."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

Kind: TypeAlias = Literal["leaf", "wood"]
Patterns: TypeAlias = Sequence[tuple[re.Pattern[str], Kind]]

LEAF = re.compile("leaf|leaves|foliage|twig|needle|frond|blossom|flower", re.IGNORECASE)
WOOD = re.compile("bark|branch|trunk|stem|wood", re.IGNORECASE)
"""Words in the names of materials and objects. Not 'tree': it is as often the name of the whole."""

_USUAL: Patterns = ((LEAF, "leaf"), (WOOD, "wood"))


@dataclass(frozen=True)
class Mesh:
    """How a mesh is read. `leaf` and `wood` are regular expressions, any case, for names of materials, then objects.

    They come first, then the usual words, then alpha (a cut-out or blended material is leaf), then the shape: what is
    plane is leaf. `vertices_per_node` is how many mesh vertices of wood are counted as one vertex of the branch graph;
    None: the complexity of the plant is its count of mesh vertices of wood.
    """

    leaf: str | None = None
    wood: str | None = None
    vertices_per_node: float | None = None

    def __post_init__(self) -> None:
        for name in ("leaf", "wood"):
            pattern = getattr(self, name)
            try:
                if pattern is not None:
                    re.compile(pattern)
            except (re.error, TypeError) as error:
                raise ValueError(f"mesh: {name} must be a regular expression, got {pattern!r}: {error}") from None
        count = self.vertices_per_node
        if count is not None and (isinstance(count, bool) or not isinstance(count, int | float) or not 0 < count < 1e6):
            raise ValueError(f"mesh: vertices_per_node must be a number over 0, or none, got {count!r}")

    def kind(self, names: Sequence[str], see_through: bool) -> Kind | None:
        """Return what a part with these names, the material's first, is; None when only its shape can tell."""
        for patterns in (self._patterns(), _USUAL):
            for name in names:
                for pattern, kind in patterns:
                    if pattern.search(name):
                        return kind
        return "leaf" if see_through else None

    def _patterns(self) -> Patterns:
        """Return the user's patterns; where both fit a name, leaf comes first."""
        own: tuple[tuple[str | None, Kind], ...] = ((self.leaf, "leaf"), (self.wood, "wood"))
        return [(re.compile(text, re.IGNORECASE), kind) for text, kind in own if text is not None]
