"""Optimisers with ask and tell; they import nothing of the rest."""

from treefit.search.cma_es import CMAES
from treefit.search.hints import Hints
from treefit.search.optimizer import Optimizer, Strategy
from treefit.search.random_search import RandomSearch
from treefit.search.tree_ga import TreeGA

__all__ = ["CMAES", "Hints", "Optimizer", "RandomSearch", "Strategy", "TreeGA"]
