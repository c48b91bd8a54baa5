from pathlib import Path

import pytest
from hydra.core.override_parser.overrides_parser import OverridesParser
from hypothesis import given
from hypothesis import strategies as st

from experiments.command_check import check
from experiments.command_line import prepare, quote, split_names
from experiments.errors import UserError


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def values(argument: str) -> list[str]:
    override = OverridesParser.create().parse_override(argument)
    if not override.is_sweep_override():
        return [str(override.value())]
    return [OverridesParser.create().parse_rule(value, "element").text for value in override.sweep_string_iterator()]


@pytest.mark.parametrize(
    "name",
    [
        "my pine (1).png", "pine=2.png", "été.png", "松.png", "a, b.png", "[1].png", "{x}.png", "it's.png", "a:b.png",
        "#1.png", "50%.png", "a*b.png", "null", "true", "~x.png", "a\\b.png", "a&b.png", " lead.png", 'say "a".png',
    ],
)  # fmt: skip
def test_name_of_an_existing_file_reaches_the_configuration_as_typed(here: Path, name: str) -> None:
    (here / name).touch()
    assert values(prepare([f"image={name}"])[0]) == [name]


@given(st.text(st.characters(exclude_categories=["Cs", "Cc"]), min_size=1))
def test_quoted_text_means_the_same_text(text: str) -> None:
    if "${" not in text:
        assert values(f"image={quote(text)}") == [text]


def test_interpolation_in_a_name_is_no_interpolation() -> None:
    assert quote("${a}.png") == r"'\${a}.png'"


@pytest.mark.parametrize("argument", ["image='a b.png'", 'image="a b.png"', "image=null", "image=", "seed=3", "-m"])
def test_what_hydra_can_read_already_stays(here: Path, argument: str) -> None:
    assert prepare([argument]) == [argument]


@pytest.mark.parametrize("key", ["mask.path", "preset", "hydra.run.dir", "+image"])
def test_other_settings_that_are_paths_are_quoted_too(here: Path, key: str) -> None:
    assert values(prepare([f"{key}=a (b).png"])[0]) == ["a (b).png"]


@pytest.mark.parametrize("argument", ["values={whorl: 4}", "values.whorl=4", "+generator.fixed.whorl=4"])
def test_values_may_have_any_name(here: Path, argument: str) -> None:
    (prepared,) = prepare([argument])
    check(["task=grow", prepared], sweep=False)
    assert prepared == "++" + argument.lstrip("+")


def test_list_of_pictures_becomes_a_sweep(here: Path) -> None:
    (here / "a, b.png").touch()
    assert values(prepare(["-m", "image=x.png,a, b.png,y z.png"])[1]) == ["x.png", "a, b.png", "y z.png"]


def test_pattern_becomes_the_files_that_it_matches_in_order(here: Path) -> None:
    (here / "my trees").mkdir()
    for name in ("c.jpg", "a 1.jpg", "b.png"):
        (here / "my trees" / name).touch()
    assert values(prepare(["-m", "image=my trees/*.jpg"])[1]) == ["my trees/a 1.jpg", "my trees/c.jpg"]


def test_pattern_of_one_file_needs_no_sweep(here: Path) -> None:
    (here / "one.jpg").touch()
    assert values(prepare(["image=*.jpg"])[0]) == ["one.jpg"]


def test_pattern_without_files_is_an_error(here: Path) -> None:
    with pytest.raises(UserError, match=r"image: no file matches the pattern '\*.jpg'"):
        prepare(["-m", "image=*.jpg"])


def test_several_pictures_without_sweep_are_an_error(here: Path) -> None:
    with pytest.raises(UserError, match=r"image: 'a.png,b.png' means 2 files; add -m"):
        prepare(["image=a.png,b.png"])


def test_split_prefers_the_longest_name_that_exists() -> None:
    assert split_names("a,b,c", {"a,b", "a"}.__contains__) == ["a,b", "c"]


@pytest.mark.parametrize("name", ["old", "old run", "it's (2)"])
def test_resume_sets_the_run_folder(here: Path, name: str) -> None:
    folder = here / name
    folder.mkdir()
    (folder / "config.yaml").touch()
    tracking, resume, run = prepare([f"resume={name}", "tracking=none"])
    assert tracking == "tracking=none"
    assert values(resume) == values(run) == [str(folder.resolve())]


def test_no_resume_can_be_said(here: Path) -> None:
    assert prepare(["resume=null", "seed=3"]) == ["resume=null", "seed=3"]


@pytest.mark.parametrize("setting", ["seed=3", "optimizer.evaluations=9", "generator=simplegen", "hydra.run.dir=x"])
def test_resume_refuses_what_would_change_the_search(here: Path, setting: str) -> None:
    (here / "config.yaml").touch()
    with pytest.raises(UserError, match=r"resume: the run keeps its settings, leave out"):
        prepare(["resume=.", setting])


def test_resume_of_a_folder_without_a_run_is_an_error(here: Path) -> None:
    with pytest.raises(UserError, match=r"is not the folder of a run"):
        prepare(["resume=."])


def test_resume_of_several_runs_is_an_error(here: Path) -> None:
    with pytest.raises(UserError, match=r"resume: goes on with one run"):
        prepare(["-m", "resume=."])
