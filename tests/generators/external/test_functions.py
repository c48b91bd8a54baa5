"""Python functions as generators: what they may return, how they are named, what is said of those that are wrong."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from generators.external import External
from generators.external.faults import GeneratorFault
from generators.external.space import space_of
from treefit.plant import Budget, Plant

MODULE = "tests.generators.external.my_trees"
SPACE = space_of({"parameters": [{"name": "height", "low": 5, "high": 20}], "fixed": {"kind": "oak"}})


class Grown:
    """Grows plants by functions of my_trees, and ends their processes."""

    def __init__(self) -> None:
        self.all: list[External] = []

    def by(self, function: str, **settings: str) -> External:
        self.all.append(External(callable=f"{MODULE}.{function}", space=SPACE, **settings))
        return self.all[-1]

    def plant(self, function: str, **settings: str) -> Plant:
        return self.by(function, **settings)({"height": 8.0, "kind": "oak"}, 1, Budget())


@pytest.fixture(scope="module")
def grown() -> Iterator[Grown]:
    grown = Grown()
    yield grown
    for generator in grown.all:
        generator.close()


def test_arrays_become_a_plant_whatever_the_function_prints(grown: Grown) -> None:
    assert grown.plant("arrays").position[:, 2].tolist() == [0, 4, 8]


def test_a_plant_comes_as_it_is(grown: Grown) -> None:
    plant = grown.plant("plant")
    assert plant.leaf_size.tolist() == [[0.5, 0.25]]
    assert plant.leaf_axis.tolist() == [[1, 0, 0]]


def test_y_upwards_is_turned_once(grown: Grown) -> None:
    assert grown.plant("lying", up="y").position.tolist() == [[0, 0, 0], [0, 0, 3], [1, 0, 6]]


@pytest.mark.slow
def test_a_mesh_is_read_and_tells_its_complexity(grown: Grown) -> None:
    plant = grown.plant("scene")
    assert plant.position[:, 2].max() == pytest.approx(8, abs=0.3)
    assert plant.radius.max() == pytest.approx(0.2, rel=0.1)
    assert plant.n_leaves == 1
    assert plant.complexity is not None
    assert plant.complexity >= 16


@pytest.mark.slow
def test_a_mesh_may_lie_in_either_way(grown: Grown) -> None:
    standing, lying = grown.plant("scene"), grown.plant("lying_scene", up="y")
    np.testing.assert_array_equal(standing.position, lying.position)
    np.testing.assert_array_equal(standing.leaf_axis, lying.leaf_axis)


@pytest.mark.parametrize(
    ("function", "message"),
    [("raises", "LookupError: no bark left"), ("nothing", "must return a Plant, arrays by name or a trimesh scene")],
)
def test_an_error_of_the_function_is_told_in_one_line(grown: Grown, function: str, message: str) -> None:
    with pytest.raises(GeneratorFault, match=message):
        grown.plant(function)


def test_the_example_is_the_preset_of_the_module(grown: Grown) -> None:
    assert grown.by("arrays").ask_preset() == {"height": 8.0, "kind": "oak"}


def test_a_copy_in_another_process_starts_programs_of_its_own(grown: Grown) -> None:
    generator = grown.by("arrays")
    generator({"height": 8.0, "kind": "oak"}, 1, Budget())
    copy = pickle.loads(pickle.dumps(generator))
    grown.all.append(copy)
    assert copy({"height": 6.0, "kind": "oak"}, 1, Budget()).position[2, 2] == 6
    assert (copy.name, copy.version, copy.space) == (generator.name, generator.version, generator.space)


def test_a_plant_over_the_budget_is_cut_and_says_so(grown: Grown) -> None:
    plant = grown.by("plant")({"height": 8.0, "kind": "oak"}, 1, Budget(2, 0))
    assert (plant.cut, plant.n_vertices, plant.n_leaves) == (True, 2, 0)


def test_name_version_and_space_come_from_where_the_function_lives(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "birches.py").write_text("def grow(values, seed): ...")
    (tmp_path / "space.yaml").write_text("parameters: [{name: height, low: 1, high: 2}]")
    (tmp_path / "presets").mkdir()
    (tmp_path / "presets" / "tall.yaml").write_text(
        "{generator: birches, version: old, seed: 3, values: {height: 1.9}}"
    )
    monkeypatch.chdir(tmp_path)
    before = External(callable="birches.grow")
    assert (before.name, before.space.names) == ("birches", ("height",))
    assert (before.presets["tall"].values, before.presets["tall"].version) == ({"height": 1.9}, before.version)
    (tmp_path / "birches.py").write_text("def grow(values, seed): return 1")
    assert External(callable="birches.grow").version != before.version


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({}, "give either command"),
        ({"command": ["python3"], "callable": "a.b"}, "give either command"),
        ({"callable": "grow"}, "must be package.module.function or an entry point of treefit.generators"),
        ({"callable": "no_such_trees.grow"}, "there is no module 'no_such_trees'"),
        ({"callable": "os;import shutil.rmtree"}, "must be package.module.function"),
        ({"command": ["no_such_program"]}, "there is no program 'no_such_program'"),
        ({"command": ["python3", "no_such_tree.py"]}, "there is no file 'no_such_tree.py'"),
        ({"command": "python3 my_tree.py"}, "valid list"),
        ({"command": ["python3"], "timeout": 0}, "greater than 0"),
        ({"command": ["python3"], "max_vertices": 1}, "greater than or equal to 2"),
        ({"command": ["python3"], "up": "x"}, "'z' or 'y'"),
        ({"command": ["python3"], "space": "no_such_space.yaml"}, "no_such_space.yaml: cannot be read"),
    ],
)
def test_wrong_settings_are_refused_at_once(settings: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        External(**settings)  # type: ignore[arg-type]


def test_a_space_that_is_missing_is_told_when_it_is_asked_for() -> None:
    generator = External(command=["python3"])
    with pytest.raises(ValueError, match=r"generator\.space: which parameters has python3"):
        _ = generator.space
    assert generator.with_space(SPACE).space.names == ("height",)


def test_a_size_parameter_must_be_one_of_the_space() -> None:
    with pytest.raises(ValueError, match="size_parameter: no parameter 'size'"):
        External(callable=f"{MODULE}.arrays", space=SPACE, size_parameter="size")


def test_fixed_settings_join_those_of_the_space() -> None:
    assert External(callable=f"{MODULE}.arrays", space=SPACE, fixed={"height": 7.0}).space.fixed["height"] == 7.0
    with pytest.raises(ValueError, match="no parameter 'heigth'; did you mean 'height'"):
        External(callable=f"{MODULE}.arrays", space=SPACE, fixed={"heigth": 7.0})
    np.testing.assert_array_equal(SPACE.names, ("height",))
