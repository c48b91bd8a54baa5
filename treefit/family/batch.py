"""A batch of random plants as the whole family sees them, in a file of its own, so that a killed collection goes on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from treefit.family.identity import FamilyError
from treefit.family.members import Members
from treefit.npz import DAMAGED, write_npz

LEVELS = 65536
"""Values that a gene of a stored plant takes, the middles of as many parts: genomes are exact in two bytes a gene."""


@dataclass(frozen=True, eq=False)
class Batch:
    """Plants (m,): `genomes` (m, n) uint16, `seeds`, `scores` (m, t), `features` (m, f), counts; `usable` has features.

    The file says with `digest` to which collection it belongs.
    """

    genomes: NDArray[np.uint16]
    seeds: NDArray[np.int64]
    scores: NDArray[np.float32]
    features: NDArray[np.float16]
    vertices: NDArray[np.int32]
    leaves: NDArray[np.int32]
    usable: NDArray[np.bool_]

    def __len__(self) -> int:
        """Count of plants m."""
        return len(self.genomes)


def genes(genomes: NDArray[np.uint16]) -> NDArray[np.float64]:
    """Genomes (m, n) in [0, 1] of stored ones."""
    return (genomes.astype(np.float64) + 0.5) / LEVELS


def grow_batch(members: Members, count: int, seed: tuple[int, ...]) -> Batch:
    """Grow `count` uniform random plants, each on a seed of its own; the same for the same `seed`."""
    rng = np.random.default_rng(seed)
    genomes = rng.integers(0, LEVELS, (count, len(members.space)), np.uint16)
    seeds = rng.integers(0, 2**31, count)
    seen = [members(genome, int(one)) for genome, one in zip(genes(genomes), seeds, strict=True)]
    length = max((len(one.features) for one in seen if one.features is not None), default=0)
    blank = np.zeros(length, np.float32)
    return Batch(
        genomes, seeds, np.array([one.scores for one in seen], np.float32),
        np.array([blank if one.features is None else one.features for one in seen], np.float16),
        np.array([one.vertices for one in seen], np.int32), np.array([one.leaves for one in seen], np.int32),
        np.array([one.features is not None for one in seen]),
    )  # fmt: skip


def keep_batch(path: Path, batch: Batch, digest: str) -> None:
    """Write `batch` to `path`, at once or not at all."""
    keep_arrays(path, vars(batch), digest)


def kept_batch(path: Path, count: int, digest: str) -> Batch | None:
    """Batch of `count` plants in `path`; None when there is none, or a shorter or damaged one.

    FamilyError when it is of another collection: other targets, generator, similarity or settings.
    """
    arrays = kept_arrays(path, [field.name for field in fields(Batch)])
    if arrays is None:
        return None
    if arrays.pop("digest") != digest:
        raise FamilyError(f"{path}: is of another collection (other targets, generator, similarity or seed); delete it")
    batch = Batch(**arrays)
    return batch if len(batch) == count else None


def keep_arrays(path: Path, arrays: Mapping[str, NDArray[Any]], digest: str) -> None:
    """Write `arrays` and `digest` to `path`, at once or not at all."""
    write_npz(path, {"digest": np.frombuffer(digest.encode(), np.uint8), **arrays})


def kept_arrays(path: Path, names: Sequence[str]) -> dict[str, Any] | None:
    """Arrays by `names` in `path` and its "digest", a text; None when there is no such file or a damaged one."""
    try:
        with np.load(path, allow_pickle=False) as file:
            return {"digest": bytes(file["digest"]).decode(), **{name: file[name] for name in names}}
    except DAMAGED:
        return None
