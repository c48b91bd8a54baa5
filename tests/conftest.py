"""Small plants and masks that many tests need."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from experiments.fidelity import picture_masks
from generators.simplegen import SimpleGen
from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.plant import Budget, Plant


@pytest.fixture(scope="session")
def plants() -> list[Plant]:
    """Twelve random plants of under 2,000 vertices."""
    generator, rng, found = SimpleGen(), np.random.default_rng(7), []
    while len(found) < 12:
        plant = generator(generator.space.decode(rng.random(len(generator.space))), 1, Budget())
        if plant.n_vertices < 2000 and plant.n_leaves > 30:
            found.append(plant)
    return found


@pytest.fixture(scope="session")
def pictures() -> list[Mask]:
    """Masks of the example pictures."""
    return picture_masks()


def blob(height: int = 128, width: int = 128, crown: float = 0.4, trunk: float = 0.04, bare: float = 0.3) -> Mask:
    """Tree of an elliptical crown, `crown` wide on each side, on a trunk; lengths in heights, x = 0 in the middle."""
    x, y = coordinates(height, width)
    mask = np.zeros((height, width), np.uint8)
    mask[(np.abs(x) <= trunk) & (y < bare + 0.1)] = BRANCH
    mask[(x / crown) ** 2 + ((y - (1 + bare) / 2) / ((1 - bare) / 2)) ** 2 <= 1] = FOLIAGE
    return mask


def coordinates(height: int, width: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """X and y (up) of the pixel centres in heights."""
    columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    return (columns - width / 2) / height, 1 - rows / height


@pytest.hookimpl(tryfirst=True)
def pytest_collection_finish(session: pytest.Session) -> None:
    """Tests of all workers begin when each has done this."""
    from tests.kernels import MANY, compile_share

    if len(session.items) > MANY:
        compile_share()
