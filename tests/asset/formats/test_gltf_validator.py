"""The written files against Khronos' own validator."""

import dataclasses
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from tests.asset.conftest import make_tree
from treefit.asset.formats.glb import write_glb, write_models
from treefit.asset.model import MeshCounts
from treefit.asset.settings import AssetSettings
from treefit.plant import LEAF_SHAPES, Look

HERE = Path(__file__).parent
WARNING = 1  # severity; errors are 0


def missing() -> str | None:
    """Return what the validator lacks on this machine, None when it can run."""
    if shutil.which("node") is None:
        return "Node.js is missing"
    places = [HERE.parents[1] / "node_modules", *map(Path, filter(None, os.environ.get("NODE_PATH", "").split(":")))]
    if not any((place / "gltf-validator").is_dir() for place in places):
        return "npm module gltf-validator is missing: npm install --prefix tests"
    return None


pytestmark = [pytest.mark.node, pytest.mark.skipif(missing() is not None, reason=str(missing()))]


def without_leaves(tree):
    none, no_size = np.zeros((0, 3), np.float32), np.zeros((0, 2), np.float32)
    return dataclasses.replace(tree, leaf_position=none, leaf_axis=none, leaf_normal=none, leaf_size=no_size)


def written(folder: Path, tree, textured) -> dict[str, MeshCounts]:
    """Write files of every kind; their counts by name."""
    small = AssetSettings(texture_size=64)
    plants = {
        "bare": (without_leaves(tree), AssetSettings(sides=3, texture_size=64)),
        "lobed": (dataclasses.replace(tree, look=Look(5, 0.1, "tuft")), small),
        "plain": (tree, AssetSettings(texture_size=0)),
        "wind": (tree, AssetSettings(texture_size=64, vertex_colours="wind")),
        **{shape: (tree, AssetSettings(leaf_outline=shape, texture_size=64)) for shape in LEAF_SHAPES},
    }
    counts = {name: write_glb(plant, folder / f"{name}.glb", settings) for name, (plant, settings) in plants.items()}
    for first in ("occlusion", "wind"):
        settings = AssetSettings(vertex_colours=first)
        write_models([textured], folder / f"textured_{first}.glb", settings)
        counts[f"textured_{first}"] = textured.counts
    second = dataclasses.replace(textured, name="tree_LOD1")
    write_models([textured, second], folder / "levels.glb", AssetSettings())
    both = MeshCounts(2 * textured.counts.vertices, 2 * textured.counts.triangles)
    return {**counts, "levels": both}


@pytest.fixture(scope="module")
def reports(textured, tmp_path_factory) -> list[tuple[str, MeshCounts, dict]]:
    """Name, counts and the validator's report of each file."""
    folder = tmp_path_factory.mktemp("validated")
    counts = written(folder, make_tree(branches=12, twigs=4, leaves=200), textured)
    command = ["node", str(HERE / "validate.mjs"), *(str(folder / f"{name}.glb") for name in counts)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    found = [json.loads(line) for line in done.stdout.splitlines()]
    return [(name, count, report) for (name, count), report in zip(counts.items(), found, strict=True)]


def test_there_is_nothing_to_mend_or_to_warn_of(reports):
    issues = {name: report["issues"]["messages"] for name, _, report in reports}
    assert {name: messages for name, messages in issues.items() if _graver(messages)} == {}


def test_textures_are_used_and_so_are_the_colours(reports):
    """A texture place without a texture is told as information, and is there for a user's own textures."""
    for name, _, report in reports:
        told = {message["pointer"].rpartition("/")[2] for message in report["issues"]["messages"]}
        assert told <= ({"TEXCOORD_0"} if name == "plain" else set()), name


def test_counts_are_those_of_the_file(reports):
    for name, count, report in reports:
        info = report["info"]
        assert (info["totalVertexCount"], info["totalTriangleCount"]) == (count.vertices, count.triangles), name


def _graver(messages: list[dict]) -> bool:
    return any(message["severity"] <= WARNING for message in messages)
