"""Kernels: how numba compiles those of the scenery; without the wrapper for C it takes a tenth less."""

from __future__ import annotations

from typing import Any

KERNEL: dict[str, Any] = {"cache": True, "nogil": True, "no_cfunc_wrapper": True}
"""Kernels that Python calls. Not those of treefit.plant.compiling: with its fast arithmetic scenes would change."""

INNER: dict[str, Any] = {**KERNEL, "cache": False, "no_cpython_wrapper": True}
"""Kernels that only kernels call."""
