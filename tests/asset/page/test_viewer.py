import base64
import hashlib
import json
import re
import zlib

import numpy as np
import pytest

from tests.asset.page.hostile import NAMES
from treefit.asset import AssetSettings, FactRow, FactTable, Level, ParameterRow, ShownTree, write_glb, write_viewer

PICTURE = np.full((40, 30, 3), 120, np.uint8)
MASK = np.zeros((80, 60), np.uint8)
MASK[20:70, 10:50] = 2
MASK[70:76, 29:31] = 1


@pytest.fixture(scope="module")
def glb(tree, tmp_path_factory):
    file = tmp_path_factory.mktemp("glb") / "tree.glb"
    write_glb(tree, file, AssetSettings(sides=3, texture_size=0))
    return file


def page(folder, trees, **more) -> str:
    write_viewer(folder / "v.html", trees, PICTURE, MASK, **more)
    return (folder / "v.html").read_text(encoding="utf-8")


def named(name: str, glb) -> ShownTree:
    table = FactTable(name, [FactRow(name, [name], name)], [name])
    return ShownTree(name, glb, [table], name, preset=name, folder=name)


def facts_in(text: str) -> dict:
    return json.loads(re.search(r'<script id="facts"[^>]*>(.*?)</script>', text, re.DOTALL).group(1))


def test_the_page_holds_every_tree_whole(glb, tmp_path):
    rows = [FactRow("score", (0.98765, "-"), "how good"), FactRow("vertices", (12345, 12.34))]
    table = FactTable("How alike", rows, ("this", "others"), folded=True)
    first = ShownTree(
        "first", glb, [table], "score 0.9", 8.0, MASK, PICTURE, "seed: 1\n", "candidates/1", [Level(7, 1.0)]
    )
    text = page(tmp_path, [first, ShownTree("second", glb)])
    trees = facts_in(text)["trees"]
    assert [tree["name"] for tree in trees] == ["first", "second"]
    files = re.findall(r'<script class="glb"[^>]*>(.*?)</script>', text)
    assert [zlib.decompress(base64.b64decode(file)) for file in files] == [glb.read_bytes()] * 2
    assert trees[0]["tables"] == [
        {"title": "How alike", "columns": ["this", "others"], "folded": True, "rows": [
            {"name": "score", "meaning": "how good", "values": ["0.988", "-"]},
            {"name": "vertices", "meaning": "", "values": ["12,345", "12.3"]},
        ]},
    ]  # fmt: skip
    assert (trees[0]["preset"], trees[0]["folder"], trees[0]["note"]) == ("seed: 1\n", "candidates/1", "score 0.9")
    assert trees[0]["levels"] == [{"triangles": 7, "iou": 1.0}]
    assert trees[1]["mask"] is None
    assert trees[1]["levels"] == []


def test_the_tree_is_placed_as_in_the_comparison(glb, tmp_path):
    told = facts_in(page(tmp_path, [ShownTree("a", glb, mask=MASK)]))
    assert (told["picture"]["top"], told["picture"]["bottom"]) == (20 / 80, 76 / 80)
    assert told["picture"]["base"] == pytest.approx(30 / 60)
    assert told["picture"]["reach"] == pytest.approx(20 / 56)
    assert told["trees"][0]["reach"] == 20 / 80


def test_a_mask_without_a_tree_does_no_harm(glb, tmp_path):
    write_viewer(tmp_path / "v.html", [ShownTree("a", glb, mask=0 * MASK)], PICTURE, 0 * MASK)
    assert facts_in((tmp_path / "v.html").read_text(encoding="utf-8"))["picture"]["bottom"] == 1


def test_parameters_come_with_their_difference(glb, tmp_path):
    rows = [
        ParameterRow("height", (0.29, 0.2901), (0.1, 0.35), "m", "how high"),
        ParameterRow("kind", ("oak", "fir"), (None, None)),
        ParameterRow("whorl", (3, 3), (0.5, 0.5)),
    ]
    told = facts_in(page(tmp_path, [ShownTree("a", glb), ShownTree("b", glb)], parameters=rows))["parameters"]
    assert told[0] == {"name": "height", "unit": "m", "meaning": "how high", "values": ["0.29", "0.2901"],
                       "places": [0.1, 0.35], "differs": True, "spread": 0.25}  # fmt: skip
    assert [(row["differs"], row["spread"]) for row in told[1:]] == [(True, 1), (False, 0)]


def test_200_hostile_names_stay_text(tmp_path):
    """In every place that a name can stand in; what they do in a browser is in test_in_browser.py."""
    glb = tmp_path / "any.glb"
    glb.write_bytes(b"any bytes")
    trees = [named(name, glb) for name in NAMES]
    rows = [ParameterRow(name, [name] * 200, [None] * 200, name, name) for name in NAMES]
    text = page(tmp_path, trees, parameters=rows, title=NAMES[0])
    assert len(set(NAMES)) == 200
    plain = page(tmp_path, [ShownTree("a", glb)] * 200)
    for piece in ("<script", "</script", "<!--", "<img", "<style", "</style"):
        assert text.lower().count(piece) == plain.lower().count(piece)
    told = facts_in(text)
    assert [tree["name"] for tree in told["trees"]] == NAMES
    assert [tree["tables"][0]["rows"][0]["values"] for tree in told["trees"]] == [[name] for name in NAMES]
    assert [row["meaning"] for row in told["parameters"]] == NAMES


def test_the_page_needs_nothing_from_outside(glb, tmp_path):
    text = page(tmp_path, [ShownTree("a", glb)])
    assert not re.search(r"<(script|img|link|iframe)[^>]*(src|href)=[\"'](?!data:)", text)
    assert "localStorage" not in text
    assert "$B64GLTF" not in text
    assert "{{" not in text.split("<script>")[0]


def test_only_its_own_scripts_may_run(glb, tmp_path):
    text = page(tmp_path, [ShownTree("a", glb)])
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text).group(1)
    for kind in ("script", "style"):
        inside = re.findall(rf"<{kind}>(.*?)</{kind}>", text, re.DOTALL)
        hashes = [base64.b64encode(hashlib.sha256(part.encode()).digest()).decode() for part in inside]
        assert re.search(rf"{kind}-src ([^;]*)", policy).group(1) == " ".join(f"'sha256-{each}'" for each in hashes)
    assert policy.startswith("default-src 'none'; ")
    assert "unsafe" not in policy
    assert "http" not in policy


def test_the_same_trees_give_the_same_bytes(glb, tmp_path):
    trees = [ShownTree("a", glb, mask=MASK, picture=PICTURE)]
    assert page(tmp_path, trees) == page(tmp_path, trees)


def test_a_viewer_without_trees_is_refused(tmp_path):
    with pytest.raises(ValueError, match="one tree or more"):
        write_viewer(tmp_path / "v.html", [], PICTURE, MASK)
