"""Parameters of GEGen, with ranges in which most random genomes are plausible trees. Angles in degrees."""

from __future__ import annotations

from treefit.plant import LEAF_SHAPES, Parameter, ParameterSpace

OWN_SHAPE = "auto"
"""The shape of leaves that says nothing: it follows from their proportions."""


def _number(name: str, low: float, high: float, default: float, unit: str, doc: str, log: bool = False,
            least: float = -1e6, most: float = 1e6) -> Parameter:  # fmt: skip
    return Parameter(name, low, high, default, unit, "log" if log else "linear", "float", (), doc, least, most)


def _count(name: str, low: int, high: int, default: int, unit: str, doc: str, log: bool = False,
           least: float = 0, most: float = 1e6) -> Parameter:  # fmt: skip
    return Parameter(name, low, high, default, unit, "log" if log else "linear", "int", (), doc, least, most)


_SIZE = (
    _number("internode", 0.05, 1.0, 0.25, "m", "length of an internode: the size, and nothing else", least=1e-3),
    _count("age", 6, 30, 24, "years", "years that the tree grows", least=1, most=100),
    _count("leader", 22, 60, 36, "internodes", "height of the grown tree (Xm of the growth equation)", True, 4, 400),
    _number("start", 1.0, 4.0, 2.0, "internodes", "height in the first year (X0)", least=0.1),
    _number("growth_rate", 0.2, 0.6, 0.35, "1/year", "how fast it comes to its height (r)", least=0.01, most=5),
    _count(
        "internodes", 1000, 10000, 3000, "internodes", "grown in the whole life, lost branches too", True, 10, 200_000
    ),
    _number("vigour", 1, 8, 4, "internodes/year", "what a bud in full light can feed at most", least=0),
)
_SHARING = (
    _number(
        "apical_control",
        -0.15,
        0.35,
        0.05,
        "log",
        "what the leader gets by its laterals, as log(lambda / (1 - lambda))",
    ),
    _number("apical_loss", 0.0, 0.4, 0.1, "log", "what apical_control loses until the tree is grown"),
    _number("apical_branches", -0.2, 0.4, 0.05, "log", "the same as apical_control for branches"),
    _number(
        "branch_growth",
        0.2,
        1.0,
        1.0,
        "share",
        "what a branch may grow in a year by what the leader may",
        least=0.01,
        most=1,
    ),
    _number(
        "priority", 0.0, 0.2, 0.03, "share", "weight lost from one bud of an axis to the next in its list", least=0
    ),
)
_BUDS = (
    _count("levels", 3, 5, 5, "levels", "levels of branches, the trunk included", least=1, most=9),
    _count("whorl", 1, 4, 1, "buds", "lateral buds at a joint of the trunk", least=1, most=12),
    _number("bud_share", 0.4, 1.0, 0.75, "share", "joints that have lateral buds", least=0, most=1),
    _number(
        "acrotony",
        0.0,
        1.0,
        0.5,
        "share",
        "how much weaker lateral buds are at the base of a year's shoot than at its tip",
        least=0,
        most=1,
    ),
    _number(
        "variation",
        0.0,
        1.5,
        0.5,
        "log",
        "random part of the weight of lateral buds, as the deviation of its logarithm",
        least=0,
    ),
    _count("bud_life", 1, 8, 4, "years", "years that a lateral bud waits for light", least=1),
)
_DIRECTIONS = (
    _number("angle", 25, 110, 65, "deg", "between the trunk and its lowest branches"),
    _number("angle_top", 15, 90, 45, "deg", "between the trunk and its highest branches"),
    _number("angle_branches", 20, 80, 45, "deg", "between a branch and its children"),
    _number("angle_variation", 0, 30, 10, "deg", "random part of these angles"),
    _number("phyllotaxis", 90, 180, 137.5, "deg", "azimuth from one joint to the next"),
    _number("flatness", 0.0, 1.0, 0.3, "share", "how much children of branches keep to a level plane", least=0, most=1),
    _number("light_seeking", 0.0, 1.5, 0.6, "1", "pull of the best-lit point by the direction so far (mu)", least=0),
    _number("straightness", 0.0, 0.6, 0.2, "1", "pull upwards on the trunk"),
    _number("tropism", -0.15, 0.25, 0.05, "1", "pull upwards at the base of branches"),
    _number("tropism_change", -1.0, 0.5, 0.0, "1", "what that pull gains along a branch as long as the tree is high"),
    _number("wobble", 0.0, 0.4, 0.15, "1", "random part of every direction", least=0),
)
_LIGHT = (
    _number("shade", 0.03, 1.0, 0.3, "1", "shade below the leaves of a joint", True, least=0),
    _number(
        "light_right",
        -0.6,
        0.6,
        0.0,
        "1",
        "metres to the right that the light comes from by one of height",
        least=-0.7,
        most=0.7,
    ),
    _number("neighbour_left", 0.0, 1.0, 0.0, "heights", "height of the neighbours to the left", least=0),
    _number("neighbour_right", 0.0, 1.0, 0.0, "heights", "height of the neighbours to the right", least=0),
    _number("gap", 0.15, 0.6, 0.35, "heights", "from the trunk to the neighbours", least=0),
    _number("shedding", 0.01, 0.25, 0.1, "1", "light a joint under which a branch is given up", True, least=0),
    _number("shed_memory", 0.0, 1.0, 0.6, "share", "wood of lost branches that their parents keep", least=0, most=1),
)
_TRUNK = (
    _number("trunk", 0.0, 0.5, 0.15, "share", "bare trunk by the height of the leader", least=0, most=0.95),
    _number("lean", -12, 12, 0, "deg", "of the trunk, to the right", least=-80, most=80),
    _number("bend", -25, 25, 0, "deg", "of the bare trunk to its top, to the right", least=-180, most=180),
    _count("forks", 0, 6, 0, "branches", "that begin together at the top of the bare trunk", most=12),
    _number("fork_angle", 15, 70, 40, "deg", "between the trunk and these"),
)
_WOOD = (
    _number("tip_radius", 0.01, 0.06, 0.025, "internodes", "radius of the youngest twigs", True, least=1e-4),
    _number("pipe", 1.8, 3.0, 2.3, "1", "exponent of the pipe model", least=1, most=10),
)
_LEAVES = (
    _count("leaf_years", 1, 6, 2, "years", "years that leaves live", least=0, most=100),
    _number("leaf_number", 0, 16, 6, "leaves", "of a joint in full light", least=0, most=64),
    _number("leaf_light", 0.0, 2.0, 0.5, "1", "power of the light that thins the leaves", least=0),
    _number("leaf_angle", 20, 90, 55, "deg", "between a shoot and its leaves"),
    _number("leaf_length", 0.4, 1.4, 0.9, "internodes", "length of a leaf", True, least=0.01),
    _number("leaf_width", 0.15, 1.0, 0.6, "share", "width of a leaf by its length", least=0.01),
    Parameter(
        "leaf_shape", default=OWN_SHAPE, kind="choice", choices=(OWN_SHAPE, *LEAF_SHAPES), doc="outline of a leaf"
    ),
)

SPACE = ParameterSpace(
    (*_SIZE, *_SHARING, *_BUDS, *_DIRECTIONS, *_LIGHT, *_TRUNK, *_WOOD, *_LEAVES), {"leaf_shape": OWN_SHAPE}
)
"""No search has the shape of leaves as a gene, presets set it: no mask sees it."""

FIXED = {
    "internode": 0.25, "age": 24, "start": 2.0, "vigour": 4.0, "levels": 5, "bud_life": 4, "angle_variation": 10.0,
    "phyllotaxis": 137.5, "straightness": 0.2, "shed_memory": 0.6, "bend": 0.0, "leaf_years": 2,
    "leaf_light": 0.5, "leaf_angle": 55.0, "leaf_width": 0.6,
}  # fmt: skip
"""Not searched: no picture shows metres; the others do what a neighbour does."""
