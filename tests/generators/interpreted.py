"""GEGen run by Python instead of numba, so that tests can look into a year: slow, for small trees."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pkgutil import iter_modules

import numpy as np
import pytest

from generators import gegen
from generators.gegen import growth

MODULES = [import_module(f"generators.gegen.{module.name}") for module in iter_modules(gegen.__path__)]


@contextmanager
def interpreted() -> Iterator[pytest.MonkeyPatch]:
    """Kernels of GEGen are plain functions inside; the patch that is given takes further changes back too."""
    with pytest.MonkeyPatch.context() as patch, np.errstate(over="ignore"):
        for module in MODULES:
            for name, value in vars(module).items():
                plain = getattr(value, "py_func", None)
                if plain is not None and plain.__module__.startswith("generators.gegen"):
                    patch.setattr(module, name, plain)
        patch.setattr(growth, "_fixed", lambda numbers, _: tuple(numbers.tolist()))
        yield patch
