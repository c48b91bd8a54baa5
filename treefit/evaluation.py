"""Evaluation: genomes become scores in parallel; the only place that knows joblib."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, Literal, Protocol, TypeAlias, TypeVar

import numpy as np
from joblib import Parallel, cpu_count, delayed
from joblib.parallel import ThreadingBackend
from numpy.typing import NDArray
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from treefit.objective import Objective, Score, View
from treefit.plant import Generator

Job = TypeVar("Job")
Found = TypeVar("Found")

Batch: TypeAlias = Callable[[NDArray[np.float64], NDArray[np.float64]], list[Score]]
"""Function on genomes (m, n) and floors (m,) to m scores."""


class Grower(Protocol):
    """What plants come from, and what draws them."""

    @property
    def generator(self) -> Generator:
        """Grows plants."""

    @property
    def view(self) -> View:
        """Draws plants."""


class Threads(ThreadingBackend):  # type: ignore[misc]  # joblib has no types
    """Threads of joblib that hand over what is done at once: joblib looks for it every 10 ms, half a small batch."""

    supports_retrieve_callback = False

    def retrieve_result(self, out: Any, timeout: float | None = None) -> Any:
        """Result of one task, awaited."""
        return self.retrieve_result_callback(out.get(timeout))


BACKENDS = {"threads": Threads, "processes": lambda: "loky", "serial": lambda: "sequential"}


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Evaluator:
    """Scores batches on `workers` workers (0: one a core); the result never depends on their number.

    `kind` auto takes threads where generator and view release the GIL, processes where one of them does not.
    """

    kind: Literal["auto", "serial", "threads", "processes"] = "auto"
    workers: int = Field(default=0, ge=0, le=1024)
    chunk: int = Field(default=32, ge=1)  # genomes a task, at most

    @property
    def at_once(self) -> int:
        """Count of workers."""
        return self.workers or int(cpu_count())

    def __call__(
        self, objective: Objective, genomes: NDArray[np.float64], floors: NDArray[np.float64] | None = None
    ) -> list[Score]:
        """Scores of `genomes` (m, n), in order; those that cannot be over their floor, of `floors` (m,), may be 0."""
        with self.started(objective) as batch:
            return batch(genomes, np.full(len(genomes), -np.inf) if floors is None else floors)

    @contextmanager
    def started(self, objective: Objective) -> Iterator[Batch]:
        """Keep threads for the many batches of a search; processes are kept by joblib itself."""
        workers, kind = self.at_once, self.backend(objective)
        pool = Parallel(n_jobs=workers, backend=BACKENDS[kind](), pre_dispatch="all")

        def batch(genomes: NDArray[np.float64], floors: NDArray[np.float64]) -> list[Score]:
            tasks = [delayed(_score)(objective, genomes[part], floors[part].tolist())
                     for part in parts(len(genomes), workers, self.chunk)]  # fmt: skip
            try:
                return [score for scores in pool(tasks) for score in scores]
            except Exception as error:  # a worker died: find out whose fault it was
                if kind != "processes":
                    raise
                return _one_by_one(objective, genomes, floors, type(error).__name__)

        if kind == "threads":
            with pool:
                yield batch
        else:
            yield batch

    def backend(self, objective: Grower) -> str:
        """Return threads, processes or serial for `objective`, or whatever else grows plants and draws them."""
        if self.kind != "auto":
            return self.kind
        both = (objective.generator.parallel, objective.view.parallel)
        return "threads" if both == ("threads", "threads") else "processes"


def in_parallel(
    function: Callable[[Job], Found], items: Iterable[Job], workers: int = 0, kind: str = "threads",
    *, ordered: bool = True,
) -> Iterator[Found]:  # fmt: skip
    """Yield `function` of each of `items`, by `workers` (0: one a core); `kind` is that of a backend.

    They come in order, or, when they need not be `ordered`, each at once when it is done.
    """
    backend = "threading" if kind == "threads" else BACKENDS[kind]()
    returned = "generator" if ordered else "generator_unordered"
    pool = Parallel(n_jobs=workers or cpu_count(), backend=backend, return_as=returned)
    yield from pool(delayed(function)(item) for item in items)


def parts(count: int, workers: int, most: int) -> list[slice]:
    """Tasks for `workers`: each half a worker's share of what is left, so that all end at the same time."""
    found, start = [], 0
    while start < count:
        size = min(most, -(-(count - start) // (2 * workers)))
        found.append(slice(start, start + size))
        start += size
    return found


def _score(objective: Objective, genomes: NDArray[np.float64], floors: list[float]) -> list[Score]:
    return [objective(genome, floor) for genome, floor in zip(genomes, floors, strict=True)]


def _one_by_one(
    objective: Objective, genomes: NDArray[np.float64], floors: NDArray[np.float64], reason: str
) -> list[Score]:
    return [_alone(objective, genome, floor, reason) for genome, floor in zip(genomes, floors.tolist(), strict=True)]


def _alone(objective: Objective, genome: NDArray[np.float64], floor: float, reason: str) -> Score:
    for _ in range(2):  # the first time the dead may still be on their way out, and take an innocent one along
        with suppress(Exception):
            scores: list[Score] = Parallel(n_jobs=2, backend="loky")([delayed(objective)(genome, floor)])
            return scores[0]
    return Score(0.0, failure=f"the worker process died ({reason})")
