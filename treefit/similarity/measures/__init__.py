"""Measures that are reported whatever was optimised: they compare two masks and know nothing of the search."""

from treefit.similarity.measures.agreement import Agreement, agreement, mean_agreement

__all__ = ["Agreement", "agreement", "mean_agreement"]
