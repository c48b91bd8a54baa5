import numpy as np
import pytest
import yaml

from treefit.plant import read_preset, read_presets, write_preset

VALUES = {"length": 7.123456789012345, "small": 1e-9, "count": 4, "curved": True, "kind": "yes", "größe": 1.0}


def test_a_preset_comes_back_as_it_was_written(tmp_path):
    write_preset(tmp_path / "p.yaml", generator="gegen", version="1", seed=7, values=VALUES, notes={"score": 0.5})
    preset = read_preset(tmp_path / "p.yaml")
    assert (preset.generator, preset.version, preset.seed) == ("gegen", "1", 7)
    assert preset.values == VALUES
    assert [type(value) for value in preset.values.values()] == [type(value) for value in VALUES.values()]


def test_numpy_numbers_are_written_as_plain_ones(tmp_path):
    values = {"a": np.float64(0.25), "b": np.int32(3), "c": np.bool_(True)}
    write_preset(tmp_path / "p.yaml", generator="g", version="1", seed=np.int64(1), values=values)
    assert read_preset(tmp_path / "p.yaml").values == {"a": 0.25, "b": 3, "c": True}
    assert list(yaml.safe_load((tmp_path / "p.yaml").read_text())) == ["generator", "version", "seed", "values"]


GOOD = "generator: g\nversion: '1'\nseed: 1\nvalues: {}\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is no table"),
        ("[1, 2]", "is no table"),
        ("a: [", "is no YAML file \\(line"),
        ("!!python/object:os.system {}", "is no YAML file"),
        ("generator: g\nseed: 1\n", "lacks version, values"),
        (GOOD + "colour: red\n", "no preset has: colour"),
        (GOOD.replace("seed: 1", "seed: 1.5"), "seed must be a whole number from 0 on, got 1.5"),
        (GOOD.replace("seed: 1", "seed: yes"), "seed must be a whole number"),
        (GOOD.replace("generator: g", "generator: 3"), "generator must be a name"),
        (GOOD.replace("'1'", "[1]"), "version must be a text"),
        (GOOD.replace("{}", "[1]"), "values must be a table"),
        (GOOD.replace("{}", "{a: [1]}"), r"values\.a must be a number, a text, true or false, got \[1\]"),
        (GOOD.replace("{}", "{a: .nan}"), r"values\.a must be a finite number"),
        (GOOD.replace("{}", "{1: 2}"), "parameter names must be texts"),
    ],
)
def test_a_bad_preset_is_refused_in_one_line(tmp_path, text, message):
    (tmp_path / "p.yaml").write_text(text)
    with pytest.raises(ValueError, match=message) as caught:
        read_preset(tmp_path / "p.yaml")
    assert "\n" not in str(caught.value)
    assert "p.yaml" in str(caught.value)


def test_missing_and_binary_files_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"cannot be read: No such file"):
        read_preset(tmp_path / "none.yaml")
    (tmp_path / "p.yaml").write_bytes(bytes(range(256)))
    with pytest.raises(ValueError, match="is no YAML file"):
        read_preset(tmp_path / "p.yaml")


def test_presets_of_a_folder_are_told_by_the_names_of_their_files_in_order(tmp_path):
    for name in ("willow", "ash", "big_oak"):
        write_preset(tmp_path / f"{name}.yaml", generator="g", version="1", seed=len(name), values={"a": 1.0})
    (tmp_path / "README.md").write_text("no preset")
    found = read_presets(tmp_path)
    assert {name: preset.seed for name, preset in found.items()} == {"ash": 3, "big_oak": 7, "willow": 6}
    assert list(found) == sorted(found)
    assert read_presets(tmp_path / "none") == {}


def test_one_bad_preset_of_a_folder_is_named(tmp_path):
    (tmp_path / "ash.yaml").write_text(GOOD)
    (tmp_path / "oak.yaml").write_text("a: [")
    with pytest.raises(ValueError, match=r"oak\.yaml: is no YAML file"):
        read_presets(tmp_path)
