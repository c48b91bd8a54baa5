"""Programs that grow one tree and end: the template of their command."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from generators.external import External
from generators.external.faults import Died, NoTree, TimedOut
from generators.external.one_shot import filled, is_template
from generators.external.space import space_of
from treefit.plant import Budget

SPACE = space_of({"parameters": [{"name": "trunk.height", "low": 5, "high": 20}, {"name": "bare", "type": "bool"}]})
PROGRAM = """
import json, sys, time
height, values, seed, out = sys.argv[1:]
known = json.load(open(values))
assert known == {"trunk.height": float(height), "bare": False}, known
print('{"id": 1, "ok": true}')
if seed == "2": sys.exit("no such bark")
if seed == "3": time.sleep(60)
if seed != "4":
    json.dump({"position": [[0, 0, 0], [0, 0, float(height)]], "parent": [-1, 0], "radius": [1, 0.5]}, open(out, "w"))
"""


@pytest.fixture
def generator(tmp_path: Path) -> External:
    (tmp_path / "pole.py").write_text(PROGRAM)
    command = [sys.executable, str(tmp_path / "pole.py"), "{trunk.height}", "{values}", "{seed}", "{out}.json"]
    return External(command=command, space=SPACE, timeout=0.5)


def test_a_template_is_filled_in_without_a_shell() -> None:
    command = ["tree", "--h={trunk.height}", "{bare}", "{out}.glb", "{seed}", "{values}", "{other}", "$(rm); {seed}"]
    assert is_template(command)
    assert not is_template(["tree", "{seed}"])
    values = {"trunk.height": 7.5, "bare": True}
    assert filled(command, values, 3, Path("/s/t"), Path("/s/v.json")) == [
        "tree", "--h=7.5", "true", "/s/t.glb", "3", "/s/v.json", "{other}", "$(rm); 3",
    ]  # fmt: skip


@pytest.mark.slow
def test_a_program_is_run_once_a_tree(generator: External) -> None:
    values = {"trunk.height": 9.0, "bare": False}
    assert generator(values, 1, Budget()).position[1, 2] == 9
    with pytest.raises(Died, match="status 1; its last words: no such bark"):
        generator(values, 2, Budget())
    with pytest.raises(NoTree, match="wrote no tree"):
        generator(values, 4, Budget())
    with pytest.raises(TimedOut):
        generator(values, 3, Budget())
    assert generator(values, 5, Budget()).position[1, 2] == 9
    scratch = generator._children.folder().parent
    assert list(scratch.iterdir()) == []
    generator.close()
    assert not scratch.exists()


def test_it_has_no_preset_to_ask_for(generator: External) -> None:
    assert generator.ask_preset() is None
