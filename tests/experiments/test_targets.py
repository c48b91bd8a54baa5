"""Which objects a configuration may name, and that nothing gets round it."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from experiments.errors import UserError
from experiments.extractor import build_extractor
from experiments.settings import read_settings
from experiments.targets import opted_in

TREES = '''
import subprocess
from subprocess import run
from generators.simplegen import SimpleGen


class Oak(SimpleGen):
    """A generator of the user's."""


def hand_on(what):
    return what
'''


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where the user stands, with a module and a package of his own."""
    (tmp_path / "his_trees.py").write_text(TREES)
    (tmp_path / "his_trees2.py").write_text(TREES)
    (tmp_path / "his_forest").mkdir()
    (tmp_path / "his_forest" / "__init__.py").write_text("from his_trees import Oak\n")
    (tmp_path / "his_forest" / "deep.py").write_text(TREES)
    (tmp_path / "broken_trees.py").write_text("1 / 0\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    before = set(sys.modules)
    yield tmp_path
    for name in set(sys.modules) - before:
        if name.startswith(("his_", "broken_")):
            del sys.modules[name]


def node(target: object, modules: object = (), **settings: object) -> DictConfig:
    """The group generator in a whole configuration."""
    return OmegaConf.create({"modules": modules, "generator": {"_target_": target, **settings}}).generator


@pytest.mark.parametrize("modules", [["his_trees"], "his_trees", ["other", "his_trees"]])
def test_a_module_of_the_users_own_is_let_in_by_its_name_from_where_he_stands(here: Path, modules: object) -> None:
    assert type(build(node("his_trees.Oak", modules), "generator")).__module__ == "his_trees"


def test_so_are_the_modules_of_a_package(here: Path) -> None:
    assert type(build(node("his_forest.deep.Oak", ["his_forest"]), "generator")).__module__ == "his_forest.deep"


@pytest.mark.parametrize("target", ["his_trees.Oak", "his_trees2.Oak", "his_forest.deep.Oak", "his_tree.Oak"])
def test_only_what_is_named_is_let_in_and_it_is_said_how(here: Path, target: str) -> None:
    module = target.rpartition(".")[0]
    allowed = [name for name in ("his_trees", "his_forest.deeper") if not target.startswith(f"{name}.")]
    with pytest.raises(UserError) as caught:
        build(node(target, allowed), "generator")
    words = ", ".join(("treefit", "generators", *allowed))
    told = f"generator: _target_ must be of {words}, got {target!r}; a module of yours is let in by modules=[{module}]"
    assert str(caught.value) == told
    assert "his_trees2" not in sys.modules


def test_what_such_a_module_has_from_elsewhere_is_not_let_in_with_it(here: Path) -> None:
    for target, home in [("his_trees.run", "subprocess"), ("his_forest.Oak", "his_trees")]:
        with pytest.raises(UserError, match=rf"_target_ '{target}' is not of .*, but of {home};"):
            build(node(target, [target.partition(".")[0]]), "generator")
    assert build(node("his_forest.Oak", ["his_forest", "his_trees"]), "generator")


@pytest.mark.parametrize("target", [
    "os.system", "builtins.eval", "treefitx.Bad", "treefit", "treefit.", "generators", "", "experiments.errors.blame",
    "treefit.evaluation.Parallel", "treefit.evaluation.np.load", "treefit.candidates.np.load",
    "treefit.stop.Stop.__class__", "treefit.stop.Stop.earlier.__globals__.get", "treefit.stop.Stop.__subclasses__",
    "treefit.stop.dataclass", "treefit.plant.plant.njit", "treefit.checkpoint.Path", "treefit..stop.Stop",
    "treefit.fit.time.sleep", "generators.simplegen.os.system", "treefit.nothing.There", ".treefit.stop.Stop",
    "his_trees.subprocess.run", "his_trees.hand_on.__globals__", ["treefit.stop.Stop"], None, 3,
])  # fmt: skip
@pytest.mark.parametrize("around", ["alone", "in a list", "partial", "as an argument", "not built"])
def test_nothing_else_of_the_machine_can_be_named(here: Path, target: object, around: str) -> None:
    inner = {"_target_": target}
    given: dict[str, dict[str, object]] = {
        "alone": {"_target_": target}, "in a list": {"what": [[inner]]}, "partial": {**inner, "_partial_": True},
        "as an argument": {"_args_": [inner]}, "not built": {"what": {"deep": inner}, "_recursive_": False},
    }  # fmt: skip
    group = {"_target_": "his_trees.hand_on", **given[around]}
    with pytest.raises(UserError, match=r"^generator: (_target_|cannot use _target_) ") as caught:
        build(node(**{"target": group.pop("_target_"), "modules": ["his_trees"], **group}), "generator")
    assert "\n" not in str(caught.value)


def test_a_group_cannot_let_modules_in_for_itself(here: Path) -> None:
    alone = OmegaConf.create({"_target_": "his_trees.Oak", "modules": ["his_trees"]})
    assert opted_in(alone) == ()
    with pytest.raises(UserError, match=r"must be of treefit, generators, got 'his_trees\.Oak'"):
        build(alone, "generator")
    with pytest.raises(UserError, match=r"must be of treefit, generators, got 'his_trees\.Oak'"):
        build(OmegaConf.create({"modules": [], "generator": alone}).generator, "generator")


def test_an_interpolation_is_checked_as_what_it_stands_for(here: Path) -> None:
    whole = OmegaConf.create({"modules": [], "x": "os.system", "generator": {"_target_": "${x}", "command": "true"}})
    with pytest.raises(UserError, match=r"got 'os\.system'; a module of yours is let in by modules="):
        build(whole.generator, "generator")


def test_an_extractor_of_the_users_own_is_let_in_too(here: Path) -> None:
    whole = OmegaConf.create({"modules": ["his_trees"], "mask": {"_target_": "his_trees.Oak", "crop": None}})
    assert type(build_extractor(whole.mask, "mask")).__name__ == "Oak"


def test_a_module_that_cannot_be_imported_is_told_in_one_line(here: Path) -> None:
    for name, reason in [("broken_trees", "division by zero"), ("no_trees", "No module named 'no_trees'")]:
        with pytest.raises(UserError, match=rf"^generator: cannot use _target_ '{name}.Oak': {reason}$"):
            build(node(f"{name}.Oak", [name]), "generator")


@pytest.mark.parametrize("name", ["", "os.", "a b", "a;b", "-x", "1a", ".a", "a..b", "a\n", "*", 3])
def test_what_is_no_name_of_a_module_is_refused(name: object) -> None:
    with pytest.raises(UserError, match="modules: must be names of Python modules, got"):
        build(node("treefit.stop.Stop", [name]), "generator")
    whole = OmegaConf.merge(OmegaConf.load("conf/config.yaml"), {"modules": [name], "image": "pine.png"})
    for group in ("defaults", "hydra"):
        del whole[group]
    with pytest.raises(UserError, match=r"^modules\.?0?: must"):
        read_settings(whole)
