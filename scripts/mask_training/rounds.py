"""Rounds of scenes: painted in processes of their own while the network learns from those before."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np
from numpy.typing import NDArray

from treefit.image.picture import Rgb
from treefit.mask import Mask

Painter = Callable[[int, int, int], tuple[Rgb, Mask]]
"""(seed, index, size) -> picture (size, size, 3) and classes (size, size), always the same for the same numbers."""

CHUNK = 8


@dataclass(frozen=True, eq=False)
class Scenes:
    """Pictures (n, s, s, 3) uint8 and their classes (n, s, s) uint8."""

    rgb: NDArray[np.uint8]
    classes: NDArray[np.uint8]


def paint_scenes(painter: Painter, seed: int, indices: range, size: int) -> Scenes:
    """Scenes of `indices`, painted here."""
    pairs = [painter(seed, index, size) for index in indices]
    return Scenes(np.stack([rgb for rgb, _ in pairs]), np.stack([classes for _, classes in pairs]))


def rounds(painter: Painter, seed: int, numbers: range, count: int, size: int, workers: int) -> Iterator[Scenes]:
    """Yield for each of `numbers` its `count` scenes; the next ones are painted meanwhile.

    Scene i is the same whatever the number of workers, and round r holds scenes r count .. (r + 1) count.
    """
    if workers == 0:
        yield from (paint_scenes(painter, seed, _indices(number, count), size) for number in numbers)
        return
    # a forked child would inherit the threads of torch in a state that may hang
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:

        def begin(number: int) -> list[Future[Scenes]]:
            indices = _indices(number, count)
            chunks = [indices[at : at + CHUNK] for at in range(0, count, CHUNK)]
            return [pool.submit(paint_scenes, painter, seed, chunk, size) for chunk in chunks]

        try:
            ahead = begin(numbers[0]) if numbers else []
            for number in numbers:
                now, ahead = ahead, begin(number + 1) if number + 1 in numbers else []
                yield _joined([future.result() for future in now])
        finally:
            pool.shutdown(cancel_futures=True)


def _indices(number: int, count: int) -> range:
    return range(number * count, (number + 1) * count)


def _joined(parts: list[Scenes]) -> Scenes:
    return Scenes(np.concatenate([part.rgb for part in parts]), np.concatenate([part.classes for part in parts]))
