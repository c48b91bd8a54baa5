"""Rule of GEGen: what its kernels are told of the tree. All are floats; lengths in internodes, angles in radians."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from generators.gegen.environment import STEEPEST


class Rule(NamedTuple):
    """Numbers of one tree."""

    age: float  # years that it grows
    leader: float  # its length when grown, Xm of the growth equation; the height of the tree, unit of the environment
    start: float  # its length in the first year, X0
    rate: float  # of the growth equation, r
    internodes: float  # grown by the whole tree in its life
    vigour: float  # resource that a bud in full light gathers, internodes a year
    apical: float  # log of lambda / (1 - lambda) of the trunk
    apical_loss: float  # what that loses until the tree is grown
    apical_branches: float  # the same for branches
    branch_growth: float  # internodes a year that a branch may grow by those of the leader
    priority: float  # weight lost from one bud of an axis to the next in its list
    levels: float
    whorl: float  # lateral buds at a joint of the trunk
    bud_share: float  # share of joints that have lateral buds
    acrotony: float  # how much weaker lateral buds are at the base of a shoot than at its tip
    bud_life: float  # years that a lateral bud waits
    variation: float  # random part of the weight of lateral buds, as the deviation of its logarithm
    angle: float  # between the trunk and its first branches
    angle_top: float  # between the trunk and its last branches
    angle_branches: float  # between branches and their children
    angle_variation: float
    phyllotaxis: float  # azimuth from one joint to the next
    flatness: float  # how much branches keep to the plane of their parent
    light_seeking: float  # mu
    tropism_trunk: float
    tropism: float  # upwards, at the base of a branch
    tropism_change: float  # what that gains over one height of path from the trunk
    wobble: float
    shade: float  # that a joint with leaves casts, by the area of a voxel
    light_x: float  # shear of the shadow pyramid: metres to the right that the light comes from by one metre of height
    light_y: float
    neighbour_left: float  # heights
    neighbour_right: float
    gap: float  # heights from the trunk to these
    shedding: float  # light a joint under which a branch is given up
    shed_memory: float  # share of a lost branch that its parent keeps as wood
    trunk: float  # joints of the trunk template
    lean: float
    bend: float  # of the trunk template
    forks: float  # first branches at its top
    fork_angle: float
    tip_radius: float
    pipe: float  # exponent of the pipe model
    leaf_years: float  # that leaves live
    leaf_number: float  # leaves of a joint in full light
    leaf_light: float  # power of the light that thins the leaves
    leaf_angle: float  # between a shoot and its leaves
    leaf_length: float
    leaf_width: float
    markers: float  # 1: space is told by markers, 0: by samples


def rule_of(v: Mapping[str, Any], slope: tuple[float, float], markers: bool) -> Rule:
    """Rule that values by name make; `slope` of the light is that of the environment."""
    (right, back), rad = slope, math.radians
    leader = float(v["leader"])
    return Rule(
        age=v["age"], leader=leader, start=v["start"], rate=v["growth_rate"], internodes=v["internodes"],
        vigour=v["vigour"], apical=v["apical_control"], apical_loss=v["apical_loss"],
        apical_branches=v["apical_branches"], branch_growth=v["branch_growth"], priority=v["priority"],
        levels=v["levels"], whorl=v["whorl"], bud_share=v["bud_share"], acrotony=v["acrotony"], bud_life=v["bud_life"],
        variation=v["variation"], angle=rad(v["angle"]), angle_top=rad(v["angle_top"]),
        angle_branches=rad(v["angle_branches"]), angle_variation=rad(v["angle_variation"]),
        phyllotaxis=v["phyllotaxis"] / 360, flatness=v["flatness"], light_seeking=v["light_seeking"],
        tropism_trunk=v["straightness"], tropism=v["tropism"], tropism_change=v["tropism_change"], wobble=v["wobble"],
        shade=v["shade"], light_x=min(max(v["light_right"] + right, -STEEPEST), STEEPEST), light_y=back,
        neighbour_left=v["neighbour_left"], neighbour_right=v["neighbour_right"], gap=v["gap"],
        shedding=v["shedding"], shed_memory=v["shed_memory"],
        trunk=max(round(v["trunk"] * leader), min(v["forks"], 1)), lean=rad(v["lean"]),
        bend=rad(v["bend"]), forks=v["forks"], fork_angle=rad(v["fork_angle"]), tip_radius=v["tip_radius"],
        pipe=v["pipe"], leaf_years=v["leaf_years"], leaf_number=v["leaf_number"], leaf_light=v["leaf_light"],
        leaf_angle=rad(v["leaf_angle"]), leaf_length=v["leaf_length"], leaf_width=v["leaf_length"] * v["leaf_width"],
        markers=float(markers),
    )  # fmt: skip
