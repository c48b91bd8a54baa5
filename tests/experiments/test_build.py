from dataclasses import dataclass
from typing import Annotated, Literal

import pytest
from omegaconf import DictConfig, OmegaConf
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass as checked

from experiments import targets as module
from experiments.build import build
from experiments.errors import UserError
from treefit.similarity import Mix


@checked(frozen=True, config=ConfigDict(extra="forbid"))
class Search:
    evaluations: Annotated[int, Field(gt=0)] = 5
    kind: Literal["a", "b"] = "a"
    steps: list[int] = Field(default_factory=list)


@dataclass
class Plain:
    low: int = 0

    def __post_init__(self) -> None:
        if self.low > 9:
            raise ValueError(f"plain: low must be at most 9, got {self.low}")


@pytest.fixture(autouse=True)
def _tests_may_be_built(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "ALLOWED", (*module.ALLOWED, "tests"))


def node(name: str = "Search", **settings: object) -> DictConfig:
    return OmegaConf.create({"_target_": f"{__name__}.{name}", **settings})


def test_group_becomes_its_object_with_plain_lists() -> None:
    built = build(node(evaluations=7, steps=[1, 2]), "optimizer")
    assert built == Search(7, steps=[1, 2])
    assert type(built.steps) is list


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        ({"evaluations": -5}, "optimizer.evaluations: must be greater than 0, got -5"),
        ({"evaluations": "lots"}, "optimizer.evaluations: must be a valid integer, got 'lots'"),
        ({"evaluations": 2.5}, "optimizer.evaluations: must be a valid integer, got 2.5"),
        ({"evaluations": None}, "optimizer.evaluations: must be given"),
        ({"kind": "c"}, "optimizer.kind: must be 'a' or 'b', got 'c'"),
        ({"steps": [1, "x"]}, "optimizer.steps.1: must be a valid integer, got 'x'"),
    ],
)
def test_wrong_values_are_said_in_one_line(settings: dict[str, object], line: str) -> None:
    with pytest.raises(UserError) as caught:
        build(node(**settings), "optimizer")
    assert str(caught.value) == line


def test_unknown_setting_is_told_with_those_that_there_are() -> None:
    with pytest.raises(UserError, match=r"optimizer.evalutions: no such setting; did you mean 'evaluations'\?"):
        build(node(evalutions=7), "optimizer")


def test_rule_of_a_plain_dataclass_is_passed_on() -> None:
    with pytest.raises(UserError, match=r"^view: plain: low must be at most 9, got 10$"):
        build(node("Plain", low=10), "view")


@pytest.mark.parametrize("target", ["os.system", "builtins.eval", "treefitx.Bad", "subprocess.run"])
def test_foreign_code_is_refused(target: str) -> None:
    with pytest.raises(UserError, match=r"view: _target_ must be of treefit, generators"):
        build(OmegaConf.create({"_target_": target}), "view")


def test_foreign_code_is_refused_inside_a_group_as_well() -> None:
    with pytest.raises(UserError, match=r"got 'os.system'"):
        build(node(steps=[{"_target_": "os.system", "command": "true"}]), "optimizer")


def test_target_that_is_missing_is_one_line() -> None:
    with pytest.raises(UserError, match=r"^view: cannot use _target_ 'treefit.nothing.There'") as caught:
        build(OmegaConf.create({"_target_": "treefit.nothing.There"}), "view")
    assert "\n" not in str(caught.value)


def test_what_is_no_group_is_an_error() -> None:
    with pytest.raises(UserError, match=r"view: needs a group with a _target_"):
        build(OmegaConf.create({"a": 1}), "view")


def test_the_default_similarity_of_the_library_is_that_of_the_configuration() -> None:
    assert build(OmegaConf.load("conf/similarity/treefit.yaml"), "similarity") == Mix()


def test_a_misspelt_setting_of_a_term_is_told_with_its_place() -> None:
    settings = OmegaConf.load("conf/similarity/treefit.yaml")
    settings.terms.texture.band = 4
    with pytest.raises(UserError, match=r"similarity\.terms\.texture\.band: no such setting; did you mean 'bands'"):
        build(settings, "similarity")


def test_terms_and_weights_have_the_same_names() -> None:
    settings = OmegaConf.load("conf/similarity/treefit.yaml")
    settings.weights.colour = 0.1
    with pytest.raises(UserError, match="similarity: terms and weights must have the same names, colour is in one"):
        build(settings, "similarity")
