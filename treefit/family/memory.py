"""Memory: the best plants of earlier fits of a generator, each with what its picture was like, in one small file."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from filelock import FileLock
from numpy.typing import NDArray

from treefit.checkpoint import CheckpointError, read_checkpoint, write_checkpoint
from treefit.family.features import features
from treefit.mask import Mask
from treefit.plant import Generator, Values
from treefit.view.frame import BitMask, frame_for, sample

ROWS = 128  # of the masks whose features are kept: those of a picture shall not depend on the view of a fit
SAME = 1e-6  # mean difference of features under which two pictures are one
PATIENCE = 30.0  # s that another process may hold the file

_log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Fit:
    """The best plant of a fit, and the features (f,) of its picture."""

    values: Values
    seed: int
    score: float
    version: str
    features: NDArray[np.float64]


@dataclass(frozen=True)
class Memory:
    """The last `size` fits in a file of `folder` for each generator; of the same picture the better one is kept."""

    folder: Path
    size: int = 200

    def file(self, generator: Generator) -> Path:
        """File of a generator."""
        return self.folder / f"{re.sub(r'[^A-Za-z0-9_.-]', '_', generator.name)}.npz"

    def recall(self, generator: Generator, mask: Mask, count: int, within: float = math.inf) -> list[Fit]:
        """Return the `count` fits whose pictures are most like `mask` (h, w), the nearest first.

        None is farther than `within`: root of the mean squared difference of the features, in plant heights. What is
        of another version of the generator is left out. OSError when the file cannot be read.
        """
        path, wanted = self.file(generator), features_of(mask)
        known = self._read_or_begin_anew(path)
        usable = [fit for fit in known if _is_usable(fit, generator, wanted)]
        if other := len(known) - len(usable):
            _log.warning("memory: %d of %d fits in %s are not of version %s of %s and left out",
                         other, len(known), path, generator.version, generator.name)  # fmt: skip
        near = [fit for fit in usable if _distance(fit.features, wanted) <= within]
        return sorted(near, key=lambda fit: _distance(fit.features, wanted))[:count]

    def add(self, generator: Generator, mask: Mask, values: Values, seed: int, score: float) -> None:
        """Keep the plant of `values` and `seed` that scored `score` for `mask` (h, w); OSError when it cannot be."""
        path, new = self.file(generator), Fit(values, seed, score, generator.version, features_of(mask))
        path.parent.mkdir(parents=True, exist_ok=True)
        with _alone(path):
            known = [fit for fit in self._read_or_begin_anew(path) if _is_usable(fit, generator, new.features)]
            same = [fit for fit in known if _distance(fit.features, new.features) < SAME]
            kept = [fit for fit in known if fit not in same]
            _write(path, [*kept, max([new, *same], key=lambda fit: fit.score)][-self.size :], generator.name)

    def _read_or_begin_anew(self, path: Path) -> list[Fit]:
        """Fits in the file, the oldest first; a damaged one is put aside, which is said."""
        try:
            return _read(path)
        except FileNotFoundError:
            return []
        except CheckpointError:
            aside = path.with_name(f"{path.name}.damaged")
            path.replace(aside)
            _log.warning("memory: %s is damaged; it is now %s and a new one is begun", path, aside.name)
            return []


def features_of(mask: Mask) -> NDArray[np.float64]:
    """Features (f,) of a mask (h, w) at the resolution that the memory compares at."""
    return features(BitMask.pack(sample(mask, frame_for(mask, ROWS)))).astype(np.float64)


def _is_usable(fit: Fit, generator: Generator, like: NDArray[np.float64]) -> bool:
    if fit.version != generator.version or fit.features.shape != like.shape:
        return False
    try:
        generator.space.complete(fit.values)
    except ValueError:
        return False
    return True


def _distance(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """Root of the mean squared difference of features (f,)."""
    return float(np.sqrt(np.mean((one - other) ** 2)))


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """While no other process writes the file."""
    with FileLock(path.with_name(f"{path.name}.lock"), timeout=PATIENCE):
        yield


def _write(path: Path, fits: Sequence[Fit], generator: str) -> None:
    numbers = {"features": np.array([fit.features for fit in fits]), "scores": np.array([fit.score for fit in fits]),
               "seeds": np.array([fit.seed for fit in fits], np.int64)}  # fmt: skip
    texts = [{"version": fit.version, "values": dict(fit.values)} for fit in fits]
    write_checkpoint(path, numbers, {"generator": generator, "fits": texts})


def _read(path: Path) -> list[Fit]:
    """Fits in the file; CheckpointError when it is none of a memory."""
    arrays, meta = read_checkpoint(path)
    try:
        found = np.asarray(arrays["features"], np.float64)
        rows = zip(cast(list[dict[str, Any]], meta["fits"]), arrays["seeds"], arrays["scores"], found, strict=True)
        return [Fit(text["values"], int(seed), float(score), text["version"], row) for text, seed, score, row in rows]
    except (KeyError, TypeError, ValueError) as error:
        raise CheckpointError(f"{path}: is no memory of fits") from error
