"""Numbers as lines of text, fast."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_AT_ONCE = 1 << 16  # rows; what is formatted at once is held as Python numbers


def text_rows(values: NDArray[np.generic], row: str) -> str:
    """Return the rows of `values` (n, ...) one after the other, each written as `row` says; it ends its own line."""
    parts = (values[start : start + _AT_ONCE] for start in range(0, len(values), _AT_ONCE))
    return "".join((row * len(part)) % tuple(part.ravel().tolist()) for part in parts)
