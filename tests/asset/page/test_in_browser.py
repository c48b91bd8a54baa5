"""What a browser makes of the page: run from disk and in a sandboxed frame, as mlflow shows it."""

import dataclasses
import html
import re

import numpy as np
import pytest
from PIL import Image

from tests.asset.page.browser import browse, needs_browser
from tests.asset.page.hostile import NAMES
from tests.asset.page.test_viewer import MASK, PICTURE, named
from treefit.asset import AssetSettings, ParameterRow, ShownTree, write_viewer
from treefit.asset.formats.glb import write_models
from treefit.asset.model import Model, Part, model_of

pytestmark = needs_browser
RED = np.full((64, 64, 4), (230, 30, 30, 255), np.uint8)
RED[:, ::8, 3] = 0


@pytest.fixture(scope="module")
def glb(tree, tmp_path_factory):
    """Two levels; leaves have a red texture with holes, so that red on the page shows that it was decoded."""
    file = tmp_path_factory.mktemp("glb") / "tree_lods.glb"
    parts = dict(model_of(tree, AssetSettings(sides=3, texture_size=0)).parts)
    parts["leaves"] = Part(parts["leaves"].mesh, dataclasses.replace(
        parts["leaves"].material, colour=(255, 255, 255), base=RED, cutoff=0.5))  # fmt: skip
    bare = {name: part for name, part in parts.items() if name != "leaves"}
    write_models([Model("tree_LOD0", parts), Model("tree_LOD1", bare)], file, AssetSettings())
    return file


def red_share(file) -> float:
    pixels = np.asarray(Image.open(file).convert("RGB")).astype(int)
    return float(((pixels[..., 0] > 120) & (pixels[..., 1:].max(axis=2) < 0.5 * pixels[..., 0])).mean())


@pytest.mark.slow
def test_200_hostile_names_are_shown_and_do_nothing(glb, tmp_path):
    trees = [named(name, glb) for name in NAMES]
    rows = [ParameterRow(name, [name] * len(NAMES), [None] * len(NAMES), name, name) for name in NAMES[:5]]
    small = tmp_path / "small.glb"
    small.write_bytes(b"no GLB")
    trees = [trees[0], *(dataclasses.replace(tree, glb=small) for tree in trees[1:])]
    write_viewer(tmp_path / "v.html", trees, PICTURE, MASK, rows, NAMES[0])
    page, console = browse(tmp_path / "v.html", "--dump-dom", hash="#lod=0")
    assert console == []
    body = re.search(r"<body[^>]*>", page).group(0)
    assert "data-owned" not in body
    assert 'data-drawn="1"' in body
    assert 'data-textures="1"' in body
    shown = re.findall(r'role="tab"[^>]*><span><b>(.*?)</b>', page, re.DOTALL)
    assert [html.unescape(name) for name in shown] == [name.replace("\r\n", "\n") for name in NAMES]
    assert len(re.findall(r"<(?:svg|iframe|textarea)\b", page.split('id="facts"')[0])) == 0


@pytest.mark.slow
def test_textures_show_in_a_sandboxed_frame(glb, tmp_path):
    """As mlflow's pane is: scripts run, but from no origin, and nothing may be fetched."""
    write_viewer(tmp_path / "v.html", [ShownTree("a", glb, mask=MASK)], PICTURE, MASK)
    page = html.escape((tmp_path / "v.html").read_text(encoding="utf-8"))
    (tmp_path / "frame.html").write_text(
        "<!DOCTYPE html><style>*{margin:0;border:0}iframe{position:fixed;width:100%;height:100%}</style>"
        f'<iframe sandbox="allow-scripts" srcdoc="{page}"></iframe>', encoding="utf-8")  # fmt: skip
    _, console = browse(tmp_path / "frame.html", f"--screenshot={tmp_path / 'frame.png'}")
    assert console == []
    assert red_share(tmp_path / "frame.png") > 0.02
