"""Contract: the rules that every generator keeps, tried on plants of its own."""

from treefit.plant.contract.faults import ContractError, NotTried, Shortcoming
from treefit.plant.contract.rules import RULES, Finding, Rule, name_of, try_rule
from treefit.plant.contract.same import same
from treefit.plant.contract.sample import Sample, draw_sample

__all__ = [
    "RULES", "ContractError", "Finding", "NotTried", "Rule", "Sample", "Shortcoming", "draw_sample", "name_of", "same",
    "try_rule",
]  # fmt: skip
