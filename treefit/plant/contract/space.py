"""Space: rules on the parameters of a generator, its presets, and what it says of itself."""

from __future__ import annotations

import math

from treefit.plant.contract.faults import ContractError, Shortcoming, reason
from treefit.plant.contract.same import difference
from treefit.plant.contract.sample import Attempt, Sample, grow
from treefit.plant.parameters import Parameter, Value
from treefit.plant.plant import Plant

PARALLEL = "threads", "processes"
BASES = 12
"""Plants, at most, on which a gene is moved before it is said to change nothing."""


def it_says_what_it_is(sample: Sample) -> str:
    """A generator has a name and a version, and says how several calls run at once."""
    generator = sample.generator
    for role in ("name", "version"):
        if not isinstance(getattr(generator, role), str) or not getattr(generator, role).strip():
            raise ContractError(f"{role} must be a text, got {getattr(generator, role)!r}")
    if generator.parallel not in PARALLEL:
        raise ContractError(f"parallel must be one of {', '.join(PARALLEL)}, got {generator.parallel!r}")
    return f"{generator.name}, version {generator.version}"


def the_space_is_sane(sample: Sample) -> str:
    """There is a gene, none is the seed, and size and age are parameters; defaults should lie in their ranges."""
    space, generator = sample.generator.space, sample.generator
    if not len(space):
        raise ContractError("no gene: at least one parameter must not be fixed")
    if seeds := [name for name in space.names if name.rpartition(".")[2] == "seed"]:
        raise ContractError(f"{seeds[0]} is searched: fix it, the search hands over a seed of its own")
    names = {parameter.name for parameter in space.parameters}
    for role in ("size_parameter", "age_parameter"):
        if (name := getattr(generator, role)) is not None and name not in names:
            raise ContractError(f"{role} {name!r} is no parameter of the space")
    if outside := [parameter.name for parameter in space.free if not _inside(parameter)]:
        raise Shortcoming(f"defaults out of their ranges: {', '.join(outside)}")
    return f"{len(space)} genes, {len(space.fixed)} fixed"


def values_and_genomes_round_trip(sample: Sample) -> str:
    """Values that a genome gives become a genome that gives the same values, with a value for every parameter."""
    space = sample.generator.space
    names = {parameter.name for parameter in space.parameters}
    for attempt in (*sample.attempts, sample.default):
        values = attempt.values
        if set(values) != names:
            raise ContractError(f"values lack {', '.join(sorted(names - set(values)))}", values)
        genome = space.encode(values)
        if not ((genome >= 0) & (genome <= 1)).all():
            raise ContractError(f"the genes of values are not in [0, 1]: {genome.min():g} to {genome.max():g}", values)
        told = space.decode(genome)
        if attempt is not sample.default and (lost := [name for name in names if not _alike(values[name], told[name])]):
            raise ContractError(f"{lost[0]} is {values[lost[0]]} and comes back as {told[lost[0]]}", values)
    return ""


def presets_are_plants_of_the_generator(sample: Sample) -> str:
    """Presets name the generator, its version and its parameters, and give plants."""
    generator, space = sample.generator, sample.generator.space
    for name, preset in generator.presets.items():
        if (preset.generator, preset.version) != (generator.name, generator.version):
            raise ContractError(
                f"{name} is of {preset.generator} {preset.version}, this is {generator.name} {generator.version}"
            )
        try:
            values = space.complete(preset.values)
            told = space.decode(space.encode(preset.values))
        except ValueError as error:
            raise ContractError(f"{name}: {reason(error)}") from error
        found = grow(generator, values, preset.seed, sample.budget)
        if found.plant is None:
            raise ContractError(f"{name} gives no plant: {found.failure}", values, preset.seed)
        again = space.decode(space.encode(told))
        if lost := [one for one in told if not _alike(told[one], again[one])]:
            raise ContractError(f"{name}: {lost[0]} is {told[lost[0]]} and comes back as {again[lost[0]]}", values)
    return f"{len(generator.presets)}" if generator.presets else "it has none"


def every_gene_changes_the_plant(sample: Sample) -> str:
    """Each gene, moved through most of its range, changes one of a few plants."""
    space = sample.generator.space
    idle = dict.fromkeys(space.names)
    bases = [(sample.default, sample.default.plant)] if sample.default.plant else []
    bases = [*bases, *sorted(sample.grown, key=lambda pair: pair[1].cut)][:BASES]
    for attempt, plant in bases:
        for parameter in [one for one in space.free if one.name in idle]:
            if _moved(sample, attempt, plant, parameter):
                del idle[parameter.name]
        if not idle:
            break
    if idle:
        cure = "give them a fixed value: the search goes through their ranges for nothing"
        raise Shortcoming(f"{len(idle)} of {len(space)} change none of {len(bases)} plants: {', '.join(idle)}; {cure}")
    return f"{len(space)} of {len(space)}"


def _moved(sample: Sample, attempt: Attempt, plant: Plant, parameter: Parameter) -> bool:
    """Whether a plant changes when a parameter goes to the far end of its range."""
    gene = parameter.encode(attempt.values[parameter.name])
    values = {**attempt.values, parameter.name: parameter.decode(0.9 if gene < 0.5 else 0.1)}
    found = sample.other(attempt.seed, values)
    return found is not None and (difference(plant, found) != "" or found.look != plant.look)


def _inside(parameter: Parameter) -> bool:
    if isinstance(parameter.default, str | bool):
        return True
    return parameter.low <= parameter.default <= parameter.high


def _alike(one: Value, two: Value) -> bool:
    if isinstance(one, float) and isinstance(two, float):
        return math.isclose(one, two, rel_tol=1e-6, abs_tol=1e-9)
    return one == two
