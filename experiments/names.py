"""Names of run folders; the resolver that conf/config.yaml uses for them."""

from __future__ import annotations

import re
from pathlib import PureWindowsPath

from omegaconf import OmegaConf

LONGEST = 48
"""Characters of a picture's name that are kept: file systems allow 255 bytes for the whole name."""


def run_name(task: str | None, image: str | None) -> str:
    """Safe part of a folder name: the picture's stem, or the task when there is no picture."""
    if not image:
        return str(task)
    stem = PureWindowsPath(str(image)).stem  # knows both kinds of slashes
    return re.sub(r"[^\w-]+", "_", stem).strip("_")[:LONGEST] or "picture"


# At import, so that the worker processes of a launcher know it too.
OmegaConf.register_new_resolver("run_name", run_name, replace=True)
