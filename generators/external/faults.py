"""Faults: what a foreign generator may do, by name; a run counts its failures by them."""

from __future__ import annotations


class GeneratorFault(RuntimeError):  # noqa: N818  the names of its kinds are what a run's page counts
    """A foreign generator gave no tree; the message says what it did instead."""


class Refused(GeneratorFault):
    """It answered that it cannot grow these values."""


class TimedOut(GeneratorFault):
    """It gave no answer in time."""


class Died(GeneratorFault):
    """Its process ended, or could not be started."""


class OutOfMemory(GeneratorFault):
    """It took more memory than it may."""


class Flooded(GeneratorFault):
    """It printed more than anybody reads."""


class NoTree(GeneratorFault):
    """It answered, but what it wrote is no tree."""


class TooLarge(GeneratorFault):
    """Its tree has more vertices than are read."""


class NotDeterministic(GeneratorFault):
    """It grew another plant of the same values and seed."""
