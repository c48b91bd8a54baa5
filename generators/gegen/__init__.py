"""GEGen: a tree that grows year by year under light, its buds sharing what the tree gathers."""

from generators.gegen.environment import Environment
from generators.gegen.generator import GEGen, gegen

__all__ = ["Environment", "GEGen", "gegen"]
