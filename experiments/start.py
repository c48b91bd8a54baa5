"""The setting `start`: plants that a search begins from, as files, runs or plants of the generator by name."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from experiments.errors import UserError
from experiments.preset import find_preset
from treefit.plant import Generator, Preset


def find_start(names: Sequence[str], generator: Generator) -> list[Preset]:
    """Return the presets that `names` mean: files, plants of the generator, folders of runs with their candidates.

    UserError with one line when one is none of these, of another generator, or has a parameter that it lacks.
    """
    return [find_preset(one, generator, "start") for name in names for one in _presets_in(name)]


def _presets_in(name: str) -> list[str]:
    """Return the files of the candidates in the folder of a run or of one candidate, best first; else `name`."""
    folder = Path(os.path.expanduser(name))  # noqa: PTH111  as in pictures.py
    try:
        if not folder.is_dir():
            return [name]
    except (OSError, ValueError):
        return [name]
    if (folder / "preset.yaml").is_file():
        return [str(folder / "preset.yaml")]
    found = [file for file in folder.glob("candidates/*/preset.yaml") if file.parent.name.isdigit()]
    if not found:
        raise UserError(f"start: no candidates in the folder {name}: give that of a run that came to its end")
    return [str(file) for file in sorted(found, key=lambda file: int(file.parent.name))]
