"""What the name of a parameter says of it: a count, an angle, a share, a size; or a matter of colour or detail."""

from __future__ import annotations

import re

WORDS = {
    "seed": ("seed", "rng"),
    "look": ("texture", "color", "colour", "tint", "uv", "uvs", "material", "alpha", "opacity", "shading", "shadow",
             "flatshading", "bitmap", "billboard"),
    "detail": ("resolution", "segment", "section", "subdivision", "subdivide", "detail", "lod", "quality",
               "tessellation", "sides"),
    "level": ("level", "levels", "depth", "generation", "generations", "recursion", "iteration", "iterations"),
    "count": ("count", "number", "num", "n", "amount", "children", "branches", "stems", "leaves", "whorl", "whorls",
              "nodes", "buds", "years", "age"),
    "angle": ("angle", "rotation", "rotate", "twist", "tilt", "pitch", "yaw", "roll", "bend", "curve", "curvature",
              "incline", "inclination", "slope", "azimuth", "phyllotaxis", "divergence", "degrees"),
    "share": ("probability", "chance", "ratio", "share", "fraction", "strength", "density", "randomness", "random",
              "variance", "variation", "jitter", "noise", "bias", "factor", "taper", "start", "end", "smoothness"),
    "direction": ("direction", "vector"),
    "size": ("length", "radius", "height", "width", "size", "scale", "thickness", "diameter", "distance", "spacing",
             "girth", "offset"),
}  # fmt: skip
"""Words by what they say; one of five letters or more also stands for what begins with it (angles, textured)."""

_PREFIX = 5
_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")


def words(name: str) -> list[str]:
    """Words of a name in small letters, numbers left out: "leaves.sizeVariance_2" is leaves, size, variance."""
    return [part.lower() for part in _PARTS.findall(name)]


def says(name: str) -> list[str]:
    """What the words of `name` say, that of its last word first: "leaves.sizeVariance" is share, size, count."""
    told = [kind for word in reversed(words(name)) for kind in WORDS if _is_a(word, kind)]
    return list(dict.fromkeys(told))


def family(name: str) -> str:
    """`name` without its numbers: the same for all items of a list."""
    return re.sub(r"\d+", "#", name)


def _is_a(word: str, kind: str) -> bool:
    stems = WORDS[kind]
    if word in stems or word.removesuffix("s") in stems:
        return kind != "seed" or word == "seed" or word == "rng"
    return kind != "seed" and any(len(stem) >= _PREFIX and word.startswith(stem) for stem in stems)
