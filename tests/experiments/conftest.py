"""What the tests of the tasks share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hydra.core.hydra_config import HydraConfig


@pytest.fixture(autouse=True)
def _hydra() -> Iterator[None]:
    """Tests that compose a configuration leave Hydra as it was."""
    known = HydraConfig.instance().cfg
    yield
    HydraConfig.instance().cfg = known
