"""Compiling: how numba compiles the kernels of generators and views."""

from __future__ import annotations

from typing import Any

FAST: dict[str, Any] = {
    "cache": True, "nogil": True, "error_model": "numpy", "fastmath": {"contract", "nsz", "arcp"},
    "no_cfunc_wrapper": True, "_nrt": False,
}  # fmt: skip
"""Kernels that Python calls; numbers that are not finite stay what they are, so that they draw nothing.

They make no arrays, so that references need no counting: a fifth of the time of a growing tree.
"""

INNER: dict[str, Any] = {**FAST, "cache": False, "no_cpython_wrapper": True}
"""The same for kernels that only kernels call: half the time to compile."""

ONCE: dict[str, Any] = {**INNER, "inline": "always"}
"""The same for the few long kernels with one caller: code is then made once, not once for each caller above."""
