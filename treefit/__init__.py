"""Fits parameters of procedural plant generators to one picture of a tree."""

from treefit.asset import AssetSettings, write_glb
from treefit.candidates import Candidate
from treefit.fit import Result, Stop, fit
from treefit.objective import Score
from treefit.plant import write_preset
from treefit.plant.characteristics import Characteristics
from treefit.search import CMAES, RandomSearch, TreeGA

__all__ = [
    "CMAES",
    "AssetSettings",
    "Candidate",
    "Characteristics",
    "RandomSearch",
    "Result",
    "Score",
    "Stop",
    "TreeGA",
    "fit",
    "write_glb",
    "write_preset",
]
