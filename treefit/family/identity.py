"""Identity: what files about a generator are tied to, and how they are refused when it is another one now."""

from __future__ import annotations

import hashlib

from treefit.plant import Parameter

Gene = dict[str, object]


class FamilyError(ValueError):
    """A file about a generator that is damaged, or of something else; the message is one line."""


class StaleError(FamilyError):
    """Statistics of an earlier version of the generator; the message says how to renew them."""

    def __init__(self, why: str, generator: str) -> None:
        renew = f"python run.py task=statistics generator={generator} statistics.renew=true"
        super().__init__(f"statistics of generator {generator!r} are stale: {why}; renew them: {renew}")


def describe(gene: Parameter) -> Gene:
    """What a gene means: a file holds for a space whose genes have the same descriptions."""
    return {"name": gene.name, "low": gene.low, "high": gene.high, "scale": gene.scale, "kind": gene.kind,
            "choices": list(gene.choices)}  # fmt: skip


def fingerprint(similarity: object) -> str:
    """Short hash of a similarity and its settings."""
    return hashlib.sha256(repr(similarity).encode()).hexdigest()[:16]
