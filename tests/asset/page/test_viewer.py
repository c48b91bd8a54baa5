import base64
import json
import re

import numpy as np
import pytest

from treefit.asset import AssetSettings, FactRow, FactTable, write_glb, write_viewer

PICTURE = np.full((40, 30, 3), 120, np.uint8)
MASK = np.ones((40, 30), np.uint8)


@pytest.fixture
def glb(tree, tmp_path):
    write_glb(tree, tmp_path / "tree.glb", AssetSettings(sides=3))
    return tmp_path / "tree.glb"


def trees_in(page: str) -> list[dict]:
    return json.loads(re.search(r'<script id="trees"[^>]*>(.*?)</script>', page, re.DOTALL).group(1))


def test_the_page_holds_every_tree_whole(glb, tmp_path):
    rows = [FactRow("score", (0.98765, "-"), "how good"), FactRow("vertices", (12345, 12.34))]
    table = FactTable("How alike", rows, ("this", "others"), folded=True)
    write_viewer(tmp_path / "v.html", [("first", glb, [table]), ("second", glb, [])], PICTURE, MASK)
    trees = trees_in((tmp_path / "v.html").read_text(encoding="utf-8"))
    assert [tree["name"] for tree in trees] == ["first", "second"]
    assert base64.b64decode(trees[0]["glb"]) == glb.read_bytes()
    assert trees[0]["tables"] == [
        {"title": "How alike", "columns": ["this", "others"], "folded": True, "rows": [
            {"name": "score", "meaning": "how good", "values": ["0.988", "-"]},
            {"name": "vertices", "meaning": "", "values": ["12,345", "12.3"]},
        ]},
    ]  # fmt: skip


def test_hostile_names_stay_text(glb, tmp_path):
    name = "</script><script>alert(1)</script><!-- {{three}} \\1 é\u2028"
    write_viewer(tmp_path / "v.html", [(name, glb, [FactTable(name, [FactRow(name, [name], name)])])], PICTURE, MASK)
    page = (tmp_path / "v.html").read_text(encoding="utf-8")
    assert "alert(1)</script>" not in page
    assert page.count("</script>") == 3
    assert trees_in(page)[0]["name"] == name
    assert trees_in(page)[0]["tables"][0]["rows"] == [{"name": name, "meaning": name, "values": [name]}]


def test_the_page_needs_nothing_from_outside(glb, tmp_path):
    write_viewer(tmp_path / "v.html", [("a", glb, [])], PICTURE, MASK)
    page = (tmp_path / "v.html").read_text(encoding="utf-8")
    assert not re.search(r"<(script|img|link|iframe)[^>]*(src|href)=[\"'](?!data:)", page)
    assert "localStorage" not in page
    assert "$B64GLTF" not in page
    assert "{{" not in page.split("<script>")[0]


def test_a_viewer_without_trees_is_refused(tmp_path):
    with pytest.raises(ValueError, match="one GLB file or more"):
        write_viewer(tmp_path / "v.html", [], PICTURE, MASK)
