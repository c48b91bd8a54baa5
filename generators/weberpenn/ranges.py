"""Ranges in which most random genomes are plausible trees, and what is fixed in them.

The crown's outline is the envelope of the pruning (shape 8): four numbers that change it smoothly, where shapes 0 to 7
are eight steps.

What another parameter does as well, or what shows in no mask of some thousand vertices, is fixed. Random turns of trunk
and limbs are small: large ones fit the luck of a seed, and suit no other. Halved, they score as before and keep 0.74 of
the silhouette on other seeds, not 0.72 (5,000 evaluations on six photographs, two seeds).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from generators.weberpenn.parameters import FULL, PARAMETERS
from treefit.plant import Parameter, ParameterSpace, Value

RANGES: Mapping[str, tuple[float, float]] = {
    "base_size": (0.02, 0.75), "levels": (3, 4), "ratio": (0.006, 0.035), "ratio_power": (0.9, 1.8),
    "flare": (0.0, 1.0), "leaves": (4, 50), "leaf_scale": (0.1, 0.3), "attraction_up": (-2.5, 1.5),
    "prune_ratio": (0.0, 1.0), "prune_width": (0.12, 0.6), "prune_width_peak": (0.08, 0.85),
    "prune_power_low": (0.15, 1.2), "prune_power_high": (0.15, 1.4),
    "length_0": (0.6, 1.05), "taper_0": (0.6, 1.0), "seg_splits_0": (0.0, 0.1), "split_angle_0": (5, 40),
    "curve_0": (-30, 30), "curve_back_0": (-50, 50), "curve_v_0": (0, 25), "bend_v_0": (0, 20),
    "down_angle_1": (20, 120), "down_angle_v_1": (-60, 40), "rotate_v_1": (0, 60), "branches_1": (14, 80),
    "length_1": (0.15, 1.2), "length_v_1": (0.0, 0.15), "seg_splits_1": (0.0, 0.1), "split_angle_1": (5, 50),
    "curve_1": (-80, 80), "curve_back_1": (-80, 80), "curve_v_1": (0, 60), "bend_v_1": (0, 50),
    "radius_mod_1": (0.4, 1.0), "base_size_1": (0.0, 0.5), "whorl_1": (1, 5),
    "down_angle_2": (20, 90), "down_angle_v_2": (-40, 30), "rotate_2": (-120, 150), "branches_2": (7, 50),
    "length_2": (0.15, 0.7), "length_v_2": (0.0, 0.15), "curve_2": (-90, 90), "curve_back_2": (-60, 60),
    "curve_v_2": (0, 120), "base_size_2": (0.0, 0.5), "whorl_2": (1, 3),
    "down_angle_3": (20, 90), "branches_3": (2, 8), "length_3": (0.15, 0.7),
}  # fmt: skip

LOG = ("ratio", "leaves", "leaf_scale", "branches_1", "length_1", "branches_2", "length_2", "branches_3", "length_3")

FIXED: Mapping[str, Value] = {
    "shape": 8, "base_splits": 0, "leaf_scale_x": 0.6, "leaf_bend": 0.3, "scale_0": 1.0, "scale_v_0": 0.0,
    "length_v_0": 0.0, "split_angle_v_0": 5.0, "curve_res_0": 8,
    "rotate_1": 140.0, "taper_1": 1.0, "split_angle_v_1": 5.0, "curve_res_1": 5,
    "rotate_v_2": 20.0, "taper_2": 1.0, "seg_splits_2": 0.0, "split_angle_2": 20.0, "split_angle_v_2": 0.0,
    "curve_res_2": 3, "bend_v_2": 40.0, "radius_mod_2": 1.0,
    "down_angle_v_3": 10.0, "rotate_3": 140.0, "rotate_v_3": 30.0, "length_v_3": 0.05, "taper_3": 1.0,
    "seg_splits_3": 0.0, "split_angle_3": 20.0, "split_angle_v_3": 0.0, "curve_res_3": 2, "curve_3": 0.0,
    "curve_back_3": 0.0, "curve_v_3": 40.0, "bend_v_3": 40.0, "radius_mod_3": 1.0, "base_size_3": 0.0, "whorl_3": 1,
}  # fmt: skip


def _narrowed(parameter: Parameter) -> Parameter:
    if parameter.name not in RANGES:
        return parameter
    low, high = RANGES[parameter.name]
    return replace(parameter, low=low, high=high, scale="log" if parameter.name in LOG else "linear")


TAMED = ParameterSpace(tuple(_narrowed(parameter) for parameter in PARAMETERS), {**FULL.fixed, **FIXED})
"""Some fifty free parameters."""
