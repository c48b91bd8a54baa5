"""SimpleGen, the paper's generator with a simple set of recursive rules."""

from generators.simplegen.generator import SimpleGen

__all__ = ["SimpleGen"]
