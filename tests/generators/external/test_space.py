"""Space files: what they may say, and what is said of those that are wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from generators.external.space import read_space, space_of

GOOD = """
parameters:
  - {name: height, type: float, low: 5, high: 20, default: 10, unit: m, doc: of the trunk}
  - {name: twigs, type: int, low: 10, high: 1000, log: true}
  - {name: bark.kind, type: choice, choices: [smooth, rough], default: rough}
  - {name: weeping, type: bool}
  - {name: share, low: 0, high: 1}
fixed: {share: 0.3, corners: 3, style: pixar, thin: true}
"""


def test_a_space_has_its_parameters_and_further_fixed_names(tmp_path: Path) -> None:
    (tmp_path / "space.yaml").write_text(GOOD)
    space = read_space(tmp_path / "space.yaml")
    assert space.names == ("height", "twigs", "bark.kind", "weeping")
    values = space.complete({})
    assert values == {"height": 10, "twigs": 100, "bark.kind": "rough", "weeping": False, "share": 0.3, "corners": 3,
                      "style": "pixar", "thin": True}  # fmt: skip
    assert (space.parameters[0].unit, space.parameters[0].doc) == ("m", "of the trunk")


def test_a_gene_runs_over_the_whole_range_on_its_scale() -> None:
    space = space_of({"parameters": [{"name": "n", "type": "int", "low": 1, "high": 1000, "log": True}]})
    twigs = space.parameters[0]
    assert (twigs.decode(0.0), twigs.decode(1.0)) == (1, 1000)
    assert 28 <= int(twigs.decode(0.5)) <= 34


WRONG = {
    "needs a list": {"fixed": {}},
    "only parameters and fixed": {"parameters": [], "parmeters": []},
    r"parameters\[0\]: needs a name": {"parameters": [{"low": 1}]},
    "'seed'.*never searched": {"parameters": [{"name": "seed", "low": 0, "high": 9}]},
    "it may have name": {"parameters": [{"name": "a", "min": 0}]},
    "type must be one of": {"parameters": [{"name": "a", "type": "real"}]},
    "high must be a number, got None": {"parameters": [{"name": "a", "low": 0}]},
    "low must be under high": {"parameters": [{"name": "a", "low": 2, "high": 2}]},
    "log scale needs low > 0": {"parameters": [{"name": "a", "low": 0, "high": 2, "log": True}]},
    "whole number, got 1.5": {"parameters": [{"name": "a", "type": "int", "low": 1.5, "high": 3}]},
    "needs choices": {"parameters": [{"name": "a", "type": "choice"}]},
    "two choices or more": {"parameters": [{"name": "a", "type": "choice", "choices": ["x"]}]},
    "has no low and high": {"parameters": [{"name": "a", "type": "bool", "low": 0}]},
    "must be one of x, y, got 'z'": {
        "parameters": [{"name": "a", "type": "choice", "choices": ["x", "y"], "default": "z"}]
    },
    "differ from each other": {"parameters": [{"name": "a", "low": 0, "high": 1}, {"name": "a", "low": 0, "high": 1}]},
    "fixed.b: must be a number": {"parameters": [{"name": "a", "low": 0, "high": 1}], "fixed": {"b": [1]}},
    "nothing to search": {"parameters": [{"name": "a", "low": 0, "high": 1}], "fixed": {"a": 1}},
    "must be finite|must be a number": {"parameters": [{"name": "a", "low": 0, "high": float("inf")}]},
}


@pytest.mark.parametrize("message", WRONG)
def test_what_is_wrong_is_said_in_one_line(message: str) -> None:
    with pytest.raises(ValueError, match=message) as told:
        space_of(WRONG[message])
    assert "\n" not in str(told.value)


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"none\.yaml: cannot be read"):
        read_space(tmp_path / "none.yaml")
    (tmp_path / "bad.yaml").write_text("parameters:\n  - {name: a\n")
    with pytest.raises(ValueError, match=r"bad\.yaml: is no YAML file \(line"):
        read_space(tmp_path / "bad.yaml")
