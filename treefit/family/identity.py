"""Identity: what a file about a generator is tied to, and how it is refused when the generator is another one now."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

from treefit.plant import Generator, Parameter, ParameterSpace

Gene = dict[str, object]


class FamilyError(ValueError):
    """A file about a generator that is damaged, or of something else; the message is one line."""


class StaleError(FamilyError):
    """A file of an earlier version of the generator; the message says how to renew it."""

    def __init__(self, why: str, generator: str) -> None:
        renew = f"python run.py task=statistics generator={generator} statistics.renew=true"
        super().__init__(f"statistics of generator {generator!r} are stale: {why}; renew them: {renew}")


@dataclass(frozen=True, eq=False)
class Tied:
    """What holds for one generator, its name and version, whose n `genes` have these descriptions."""

    generator: str
    version: str
    genes: tuple[Gene, ...]

    def __post_init__(self) -> None:
        if any(not isinstance(gene.get("name"), str) for gene in self.genes) or not self.genes:
            raise ValueError("genes must have names")
        if len(set(self.names)) != len(self.genes):
            raise ValueError("genes must have names that differ from each other")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the genes, in order."""
        return tuple(str(gene["name"]) for gene in self.genes)

    def changed(self, space: ParameterSpace) -> list[str]:
        """Names of the genes of `space` that are described otherwise here."""
        known = dict(zip(self.names, self.genes, strict=True))
        return [gene.name for gene in space.free if gene.name in known and known[gene.name] != describe(gene)]

    def places(self, space: ParameterSpace) -> list[int]:
        """Place here of every gene of `space`, n for one that is not known; StaleError when one is another now."""
        changed = self.changed(space)
        if changed:
            raise StaleError(f"parameter {changed[0]!r} has another range now", self.generator)
        places = {name: i for i, name in enumerate(self.names)}
        return [places.get(name, len(places)) for name in space.names]


Found = TypeVar("Found", bound=Tied)


def fitting(candidates: Iterable[tuple[str, Found]], generator: Generator) -> Found | None:
    """Of what files (their names) hold, that of the space most like the generator's own; None when none fits.

    One fits that knows some genes of the space, all of these as they are now. One that lacks genes, but for the size,
    and knows others otherwise is of another space. StaleError when all that would fit are of another version of the
    generator, or know all genes but some otherwise.
    """
    found, stale, space = [], [], generator.space
    for name, one in candidates:
        changed = one.changed(space)
        unknown = set(space.names) - {*one.names, str(generator.size_parameter)}
        if one.generator != generator.name:
            continue
        if one.version != generator.version:
            stale.append(f"{name} is of version {one.version}, the generator of {generator.version}")
        elif changed and not unknown:
            stale.append(f"parameter {changed[0]!r} has another range than in {name}")
        elif not changed and len(unknown) < len(space):
            found.append((len(set(space.names) ^ set(one.names)), name, one))
    if stale and not found:
        raise StaleError(stale[0], generator.name)
    return min(found, key=lambda each: each[:2])[2] if found else None


def describe(gene: Parameter) -> Gene:
    """What a gene means: a file holds for a space whose genes have the same descriptions."""
    return {"name": gene.name, "low": gene.low, "high": gene.high, "scale": gene.scale, "kind": gene.kind,
            "choices": list(gene.choices)}  # fmt: skip


def fingerprint(settings: object) -> str:
    """Short hash of a similarity, or of whatever says all its settings when it is printed."""
    return hashlib.sha256(repr(settings).encode()).hexdigest()[:16]
