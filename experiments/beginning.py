"""Where a search begins, and what it leaves for others: the setting `start` with the memory of earlier fits."""

from __future__ import annotations

import json
import logging
import os
from collections.abc import Sequence
from pathlib import Path

from experiments.preset import warn_of_version
from experiments.start import find_start
from experiments.start_settings import MemorySettings
from experiments.write_run import write_json
from treefit.candidates import Candidate
from treefit.family.memory import Memory
from treefit.mask import Mask
from treefit.plant import Generator, Values

KEPT = "start.json"
"""File in a run's folder with the values that its search began from: a resumed run needs the same."""

_log = logging.getLogger(__name__)


def start_of(
    names: Sequence[str], memory: MemorySettings, generator: Generator, mask: Mask, folder: Path
) -> list[Values]:
    """Values that the search for `mask` (h, w) begins from; once found they are kept in the run's `folder`."""
    if not names and not memory.use:
        return []
    if not (folder / KEPT).exists():
        presets = find_start(names, generator)
        for preset in presets:
            warn_of_version(preset, generator)
        values = [dict(preset.values) for preset in presets]
        write_json(folder / KEPT, {"values": [*values, *_recalled(memory, generator, mask)]})
    found: list[Values] = json.loads((folder / KEPT).read_text(encoding="utf-8"))["values"]
    return found


def remember(memory: MemorySettings, generator: Generator, mask: Mask, best: Candidate) -> None:
    """Keep the best candidate in the memory, if there shall be one; when it cannot be, say so."""
    if not memory.use:
        return
    try:
        _memory(memory).add(generator, mask, best.values, best.seed, best.score.total)
    except OSError as error:
        _log.warning("memory: this fit could not be kept in %s: %s", memory.folder, error.strerror or error)


def _recalled(memory: MemorySettings, generator: Generator, mask: Mask) -> list[dict[str, object]]:
    if not memory.use:
        return []
    try:
        fits = _memory(memory).recall(generator, mask, memory.count, memory.within)
    except OSError as error:
        _log.warning("memory: %s cannot be read: %s", memory.folder, error.strerror or error)
        return []
    return [dict(fit.values) for fit in fits]


def _memory(memory: MemorySettings) -> Memory:
    return Memory(Path(os.path.expanduser(memory.folder)), memory.size)  # noqa: PTH111
