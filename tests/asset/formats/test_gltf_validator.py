"""The written files against Khronos' own validator."""

import dataclasses
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from treefit.asset.formats.glb import write_glb
from treefit.asset.settings import AssetSettings
from treefit.plant import LEAF_SHAPES, Look

HERE = Path(__file__).parent


def missing() -> str | None:
    """Return what the validator lacks on this machine, None when it can run."""
    if shutil.which("node") is None:
        return "Node.js is missing"
    places = [HERE.parents[1] / "node_modules", *map(Path, filter(None, os.environ.get("NODE_PATH", "").split(":")))]
    if not any((place / "gltf-validator").is_dir() for place in places):
        return "npm module gltf-validator is missing: npm install --prefix tests"
    return None


pytestmark = [pytest.mark.node, pytest.mark.skipif(missing() is not None, reason=str(missing()))]


def reports(*paths: Path) -> list[dict]:
    command = ["node", str(HERE / "validate.mjs"), *map(str, paths)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


def without_leaves(tree):
    none, no_size = np.zeros((0, 3), np.float32), np.zeros((0, 2), np.float32)
    return dataclasses.replace(tree, leaf_position=none, leaf_axis=none, leaf_normal=none, leaf_size=no_size)


def test_every_leaf_outline_passes_without_errors_and_warnings(tree, tmp_path):
    paths, counts = [tmp_path / f"{shape}.glb" for shape in LEAF_SHAPES], []
    for shape, path in zip(LEAF_SHAPES, paths, strict=True):
        counts.append(write_glb(tree, path, AssetSettings(leaf_outline=shape)))
    for report, count in zip(reports(*paths), counts, strict=True):
        issues = report["issues"]
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
        assert report["info"]["totalVertexCount"] == count.vertices
        assert report["info"]["totalTriangleCount"] == count.triangles


def test_a_bare_tree_passes_without_errors_and_warnings(tree, tmp_path):
    write_glb(without_leaves(tree), tmp_path / "bare.glb", AssetSettings(sides=3))
    issues = reports(tmp_path / "bare.glb")[0]["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_a_lobed_trunk_passes_without_errors_and_warnings(tree, tmp_path):
    write_glb(dataclasses.replace(tree, look=Look(5, 0.1, "tuft")), tmp_path / "lobed.glb", AssetSettings())
    issues = reports(tmp_path / "lobed.glb")[0]["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
