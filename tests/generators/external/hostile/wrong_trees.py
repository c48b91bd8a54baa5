"""Ways to hand over arrays that are no tree; the answer says that it is one."""

import numpy as np
from hostile.call import Call


def nan(call: Call) -> None:
    """Gives a position that is NaN."""
    call.give(position=_put(call, "position", np.nan))


def infinite_width(call: Call) -> None:
    """Gives a vertex infinitely far to the side."""
    call.give(position=_put(call, "position", np.inf))


def too_far(call: Call) -> None:
    """Gives a position of 1e300 m, in double precision."""
    call.give(position=_put(call, "position", 1e300).astype(np.float64) * 1.0)


def nan_leaf(call: Call) -> None:
    """Gives a leaf whose axis is NaN."""
    call.give(leaf_axis=_put(call, "leaf_axis", np.nan))


def empty(call: Call) -> None:
    """Gives no vertex and no leaf."""
    call.give(**{name: array[:0] for name, array in call.tree.items()})


def one_vertex(call: Call) -> None:
    """Gives one vertex and no leaf."""
    call.give(**{name: array[: 0 if "leaf" in name else 1] for name, array in call.tree.items()})


def flat(call: Call) -> None:
    """Gives a tree without height."""
    call.give(position=call.tree["position"] * np.float32([1, 1, 0]))


def a_point(call: Call) -> None:
    """Gives a tree with all vertices and leaves in one place."""
    call.give(position=0 * call.tree["position"], leaf_position=0 * call.tree["leaf_position"])


def cycle(call: Call) -> None:
    """Gives two vertices that are each other's parent."""
    parent = call.tree["parent"].copy()
    parent[3], parent[4] = 4, 3
    call.give(parent=parent)


def own_parent(call: Call) -> None:
    """Gives a vertex that is its own parent."""
    call.give(parent=_put(call, "parent", 5))


def no_root(call: Call) -> None:
    """Gives a root that has a parent."""
    call.give(parent=np.abs(call.tree["parent"]))


def two_roots(call: Call) -> None:
    """Gives two roots."""
    call.give(parent=_put(call, "parent", -1))


def far_parent(call: Call) -> None:
    """Gives a parent that is no vertex."""
    call.give(parent=_put(call, "parent", 10**9))


def broken_parent(call: Call) -> None:
    """Gives parents as fractions."""
    call.give(parent=call.tree["parent"] + 0.5)


def text_parent(call: Call) -> None:
    """Gives parents as texts."""
    call.give(parent=call.tree["parent"].astype(str))


def complex_position(call: Call) -> None:
    """Gives positions as complex numbers."""
    call.give(position=call.tree["position"] * 1j)


def two_dimensions(call: Call) -> None:
    """Gives positions without z."""
    call.give(position=call.tree["position"][:, :2])


def one_number(call: Call) -> None:
    """Gives one number for all positions."""
    call.give(position=np.float32(3))


def short_radius(call: Call) -> None:
    """Gives one radius too few."""
    call.give(radius=call.tree["radius"][1:])


def short_leaves(call: Call) -> None:
    """Gives one size of a leaf too few."""
    call.give(leaf_size=call.tree["leaf_size"][1:])


def no_radius(call: Call) -> None:
    """Gives no radius."""
    call.give(radius=None)


def negative_radius(call: Call) -> None:
    """Gives a radius under 0."""
    call.give(radius=_put(call, "radius", -1))


def random(call: Call) -> None:
    """Gives another tree each time."""
    call.give(position=call.tree["position"] * np.random.default_rng().uniform(0.5, 1.5, 3).astype(np.float32))


def _put(call: Call, name: str, value: float) -> np.ndarray:
    """Return an array of the tree with `value` in its row 5."""
    array = call.tree[name].astype(np.float64 if abs(value) > 1e38 else call.tree[name].dtype)
    array[5, ...] = value
    return array
