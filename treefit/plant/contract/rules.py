"""Rules: all of the contract in the order in which they are tried, and what was found of one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from treefit.plant.contract.faults import ContractError, NotTried, Shortcoming, reason
from treefit.plant.contract.limits import (
    a_plant_takes_no_more_than_a_second,
    heights_are_of_one_kind,
    most_plants_fit_the_budget,
    nothing_is_cut_that_has_room,
    the_budget_is_never_passed_and_a_cut_is_told,
)
from treefit.plant.contract.purity import (
    another_seed_gives_another_plant,
    plants_stay_as_they_are,
    several_at_once_give_the_same_bytes,
    the_same_input_gives_the_same_bytes,
    values_are_left_alone,
)
from treefit.plant.contract.sample import Sample
from treefit.plant.contract.scale import the_age_parameter_counts_years, the_size_parameter_scales_and_does_nothing_else
from treefit.plant.contract.shape import (
    leaves_have_unit_axes_and_normals_at_right_angles,
    levels_rise_by_one_at_most,
    nothing_grows_below_the_ground,
    plants_rise_over_the_ground,
    random_genomes_give_valid_plants,
    the_defaults_give_a_plant,
    the_root_stands_at_the_origin,
)
from treefit.plant.contract.space import (
    every_gene_changes_the_plant,
    it_says_what_it_is,
    presets_are_plants_of_the_generator,
    the_space_is_sane,
    values_and_genomes_round_trip,
)
from treefit.plant.parameters import Values

Rule: TypeAlias = Callable[[Sample], str]
"""Raises ContractError when it is broken, Shortcoming when it only should hold; else tells authors what is so."""

RULES: tuple[Rule, ...] = (
    it_says_what_it_is,
    the_space_is_sane,
    values_and_genomes_round_trip,
    random_genomes_give_valid_plants,
    the_defaults_give_a_plant,
    the_root_stands_at_the_origin,
    nothing_grows_below_the_ground,
    plants_rise_over_the_ground,
    leaves_have_unit_axes_and_normals_at_right_angles,
    levels_rise_by_one_at_most,
    values_are_left_alone,
    the_same_input_gives_the_same_bytes,
    several_at_once_give_the_same_bytes,
    plants_stay_as_they_are,
    another_seed_gives_another_plant,
    the_budget_is_never_passed_and_a_cut_is_told,
    nothing_is_cut_that_has_room,
    the_size_parameter_scales_and_does_nothing_else,
    the_age_parameter_counts_years,
    presets_are_plants_of_the_generator,
    every_gene_changes_the_plant,
    most_plants_fit_the_budget,
    heights_are_of_one_kind,
    a_plant_takes_no_more_than_a_second,
)


@dataclass(frozen=True)
class Finding:
    """What a rule found; `values` and `seed` are those of a plant that breaks it."""

    rule: str
    verdict: Literal["ok", "warning", "failed", "not tried"]
    message: str
    values: Values | None = None
    seed: int = 0


def name_of(rule: Rule) -> str:
    """Sentence of a rule."""
    return rule.__name__.replace("_", " ")


def try_rule(rule: Rule, sample: Sample) -> Finding:
    """Try one rule; whatever a generator does becomes a finding."""
    name = name_of(rule)
    try:
        return Finding(name, "ok", rule(sample))
    except NotTried as error:
        return Finding(name, "not tried", str(error))
    except ContractError as error:
        verdict: Literal["warning", "failed"] = "warning" if isinstance(error, Shortcoming) else "failed"
        return Finding(name, verdict, str(error), error.values, error.seed)
    except Exception as error:  # of a property of the generator
        return Finding(name, "failed", f"it raised {reason(error)}")
