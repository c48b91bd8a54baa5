"""Kernels that many tests need, compiled before the first test, each by one worker of pytest-xdist alone.

A fresh clone has none. Workers that meet a kernel at the same time would both compile it: a third of it all twice.
Tests begin when all workers are ready, and load what the others have compiled.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from generators.gegen import GEGen
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.asset.conftest import make_tree
from tests.conftest import blob
from treefit.asset import AssetSettings
from treefit.asset.formats.glb import write_glb
from treefit.asset.lod.levels import levels_of
from treefit.asset.pictures.picture import picture
from treefit.plant import Budget
from treefit.similarity import Mix, PaperSimilarity
from treefit.view import BitMask, Frame, OrthographicView

MANY = 1000
"""Tests of a run in which they are compiled so; a few tests may need none."""


def compile_share() -> None:
    """Compile the kernels that are this worker's; none without workers."""
    worker, count = os.environ.get("PYTEST_XDIST_WORKER", ""), int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    if worker.removeprefix("gw").isdigit():
        for part in PARTS[int(worker.removeprefix("gw")) :: count]:
            with suppress(Exception):  # what fails here fails in its tests too, and is told there
                part()


def _files() -> None:
    tree = make_tree(leaves=100)
    with TemporaryDirectory() as folder:
        write_glb(tree, Path(folder) / "tree.glb", AssetSettings())
    picture(tree, AssetSettings(picture_size=64))
    levels_of(tree, AssetSettings(texture_size=64, lods=(0.4, 0.1, "billboard")))


def _generators_view_and_similarities() -> None:
    for generator in (GEGen(), WeberPennGen(), SimpleGen()):
        plant = generator(generator.space.complete({}), 0, Budget())
    OrthographicView()(plant, Frame(64, 2))
    bits = BitMask.pack(blob())
    for similarity in (Mix(), PaperSimilarity()):
        similarity.compare(similarity.describe(bits), similarity.describe(bits))


PARTS = (_files, _generators_view_and_similarities)
"""About equal halves, which share no kernels."""
