"""What a generator gets and gives; the only room that generators import."""

from treefit.plant.generator import Budget, Generator
from treefit.plant.parameters import Genome, Parameter, ParameterSpace, Value, Values
from treefit.plant.plant import Plant, check_plant

__all__ = [
    "Budget", "Generator", "Genome", "Parameter", "ParameterSpace", "Plant", "Value", "Values", "check_plant",
]  # fmt: skip
