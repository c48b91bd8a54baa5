"""The examples of the guide are run as they stand there."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from generators.external import External
from generators.external.space import space_of
from treefit.plant import Budget, check_plant

README = (Path(__file__).parents[3] / "generators" / "external" / "README.md").read_text(encoding="utf-8")
SPACE = """
parameters:
  - {name: height, low: 5, high: 20, unit: m}
  - {name: twigs, type: int, low: 10, high: 400, log: true}
  - {name: spread, low: 0.1, high: 0.6}
"""


def example(language: str) -> str:
    found = re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)
    assert found is not None
    return found[1]


@pytest.fixture(params=["python", "js"])
def generator(request: pytest.FixtureRequest, tmp_path: Path) -> External:
    language = str(request.param)
    if language == "js" and shutil.which("node") is None:
        pytest.skip("needs Node.js")
    file = tmp_path / ("my_tree.py" if language == "python" else "my_tree.mjs")
    file.write_text(example(language), encoding="utf-8")
    (tmp_path / "space.yaml").write_text(SPACE)
    return External(command=["python3" if language == "python" else "node", str(file)])


def test_an_example_of_the_guide_grows_trees(generator: External) -> None:
    assert generator.name == "my_tree"
    one, again, other = (generator(generator.space.complete({}), seed, Budget()) for seed in (1, 1, 2))
    check_plant(one)
    assert (one.n_leaves, one.n_vertices) == (63, 13 + 63)
    np.testing.assert_array_equal(one.position, again.position)
    assert not np.array_equal(one.position, other.position)
    assert generator.ask_preset() == {"height": 9.0, "twigs": 60, "spread": 0.4}
    generator.close()


def test_the_space_of_the_guide_is_one() -> None:
    import yaml

    blocks = re.findall(r"```yaml\n(.*?)```", README, re.DOTALL)
    assert space_of(yaml.safe_load(blocks[0])).names == ("height", "twigs", "leaf.kind", "weeping")
