"""Optimisers with ask and tell; they import nothing of the rest."""

from treefit.search.optimizer import Optimizer, Strategy
from treefit.search.random_search import RandomSearch
from treefit.search.tree_ga import TreeGA

__all__ = ["Optimizer", "RandomSearch", "Strategy", "TreeGA"]
