"""Optimisers with ask and tell; they import nothing of the rest."""

from treefit.search.cma_es import CMAES
from treefit.search.differential_evolution import DifferentialEvolution
from treefit.search.hints import Hints
from treefit.search.lshade import LSHADE
from treefit.search.optimizer import Optimizer, Strategy
from treefit.search.pycma import PyCMA
from treefit.search.random_search import RandomSearch
from treefit.search.tree_ga import TreeGA

__all__ = [
    "CMAES",
    "LSHADE",
    "DifferentialEvolution",
    "Hints",
    "Optimizer",
    "PyCMA",
    "RandomSearch",
    "Strategy",
    "TreeGA",
]
