"""Same: whether two plants have the same bytes, and a digest of a plant's."""

from __future__ import annotations

from dataclasses import replace
from hashlib import blake2b

from treefit.plant.plant import Plant

FIELDS = ("position", "radius", "parent", "level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size")


def same(one: Plant, two: Plant) -> bool:
    """Whether all arrays of two plants have the same bytes."""
    return difference(one, two) == ""


def difference(one: Plant, two: Plant) -> str:
    """Words for the first field in which two plants differ, "" when they have the same bytes."""
    for name in ("n_vertices", "n_leaves"):
        if getattr(one, name) != getattr(two, name):
            return f"{name.removeprefix('n_')}: {getattr(one, name)} and {getattr(two, name)}"
    for name in FIELDS:
        if getattr(one, name).tobytes() != getattr(two, name).tobytes():
            return f"other numbers in {name}"
    return ""


def apart(plant: Plant) -> Plant:
    """Return a copy that shares no memory: a plant may keep hold of all that its budget had room for."""
    return replace(plant, **{name: getattr(plant, name).copy("K") for name in FIELDS})


def digest(plant: Plant) -> bytes:
    """Bytes that differ when those of two plants do."""
    found = blake2b(digest_size=16)
    for name in FIELDS:
        found.update(getattr(plant, name).tobytes())
    return found.digest()
