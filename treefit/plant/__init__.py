"""What a generator gets and gives; the only room that generators import."""

from treefit.plant.generator import Budget, Generator
from treefit.plant.look import LEAF_SHAPES, LeafShape, Look
from treefit.plant.parameters import Genome, Parameter, ParameterSpace, Value, Values
from treefit.plant.plant import Plant, check_plant
from treefit.plant.preset import Preset, read_preset, read_presets, write_preset

__all__ = [
    "LEAF_SHAPES", "Budget", "Generator", "Genome", "LeafShape", "Look", "Parameter", "ParameterSpace", "Plant",
    "Preset", "Value", "Values", "check_plant", "read_preset", "read_presets", "write_preset",
]  # fmt: skip
