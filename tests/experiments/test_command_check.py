from itertools import zip_longest
from pathlib import Path

import pytest
from omegaconf import OmegaConf

from experiments.build import build
from experiments.command_check import CONFIG_FOLDER, check, check_names
from experiments.errors import UserError
from treefit.opengl import gl_missing


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tree.png").touch()


WRONG = {
    "generator=simplegn": "generator: no option 'simplegn'; did you mean 'simplegen'?",
    "generatr=gegen": "generatr: no such setting; did you mean 'generator'?",
    "optimizer.evalutions=5": "optimizer.evalutions: no such setting; did you mean 'evaluations'?",
    "candidates.cuont=5": "candidates.cuont: no such setting; did you mean 'count'?",
    "seed.x=5": "seed: has no parts, so there is no 'seed.x'",
    "optimizer.evaluations=-5": "optimizer.evaluations: must be greater than",
    "optimizer.evaluations=lots": "optimizer.evaluations: must be a valid integer",
    "seed=-1": "seed: must be greater than or equal to 0, got -1",
    "seed=x": "seed: must be a valid integer",
    "debug=maybe": "debug: must be a valid boolean",
    "candidates.count=0": "candidates.count: must be greater than or equal to 1, got 0",
    "stop.seconds=0": "stop.seconds: must be greater than 0, got 0",
    "stop=3": "stop",
    "task=mak": "task: no task 'mak'; did you mean 'mask'?",
    "image=tre.png": "image: no such file: tre.png; did you mean 'tree.png'?",
    "mask=file": "mask.path: must be given",
    "seed": "'seed': write name=value",
    "values={a": "values: cannot read '{a'",
    "=": "'=': write name=value",
    "=3": "'=3': write name=value",
    "a b=3": "a b: cannot read '3'",
    "seed=1,2": "seed: '1,2' means several runs; add -m",
    "view._target_=os.system": "view: _target_ must be of treefit, generators, got 'os.system'",
    "generator=external": "generator: give either command, e.g. generator.command=[python3,my_tree.py], or callable=",
    "characteristics.vertices=lots": "characteristics.vertices: must be a number, a range [low, high] or {min: low,",
    "characteristics.vertices={most: 5}": "or {min: low, max: high}, got {'most': 5}",
    "characteristics.vertices=1": "characteristics.vertices: must be greater than or equal to 2, got 1",
    "characteristics.triangles=20.5": "characteristics.triangles: must be a whole number, got 20.5",
    "characteristics.height=[5,3]": "characteristics.height: min must not be above max, got 5 and 3",
    "characteristics.width=from_image": "characteristics.width: from_image needs a height, e.g.",
    "memory.size=0": "memory.size: must be greater than or equal to 1, got 0",
    "mask.network.size=10": "mask.network.size: must be greater than or equal to 64, got 10",
    "memory.cuont=2": "memory.cuont: no such setting; did you mean 'count'?",
    "memory.folder=": "memory.folder: must have at least 1 character, got ''",
    "optimizer.max_population=8": "optimizer.max_population: must not be under min_population, 16, got 8",
    "optimizer.start=gues": "optimizer.start: must be 'random', 'presets', 'mixed' or 'guess', got 'gues'",
    "candidates.runners_up=1": "candidates.runners_up: must be less than or equal to 0.9, got 1",
    "objective.seeds=1.5": "objective.seeds: must be a valid integer, got 1.5",
    "objective.sedes=3": "objective.sedes: no such setting; did you mean 'seeds'?",
    "statistics.targets=2": "statistics.targets: must be greater than or equal to 3, got 2",
    "compare.optimizers=[]": "compare.optimizers: must have at least 1 item, got []",
    "compare.optimizers=[../x]": r"compare.optimizers.0: must match pattern '^\w[\w.-]*$', got '../x'",
    "start=[oak]": "start: neither a file nor a plant of simplegen: 'oak'",
    "seeds=3..1": "seeds: the last of 3..1 must not be under the first",
    "tracking.patience=-1": "tracking.patience: must be a number of seconds greater than 0, got -1",
}


@pytest.mark.parametrize("setting", WRONG)
def test_wrong_setting_is_one_clear_line(setting: str) -> None:
    with pytest.raises(UserError) as caught:
        check(["image=tree.png", setting], sweep=False)
    assert WRONG[setting] in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "wishes",
    [
        ["characteristics.vertices={max: 5000}", "characteristics.height=[8,12]", "characteristics.width=from_image"],
        ["characteristics.vertices=null", "characteristics.triangles={min: 2000, max: 9000}", "asset.sides=5"],
        ["characteristics=none", "characteristics.leaf_size={min: 0.1}"],
    ],
)
def test_wishes_are_numbers_ranges_and_limits(wishes: list[str]) -> None:
    check(["image=tree.png", *wishes], sweep=False)


def test_picture_must_be_given() -> None:
    with pytest.raises(UserError, match=r"image: which picture\?"):
        check([], sweep=False)


def test_every_run_of_a_sweep_is_checked() -> None:
    check(["image=tree.png", "seed=1,2", "generator=simplegen"], sweep=True)
    with pytest.raises(UserError, match=r"seed: must be greater"):
        check(["image=tree.png", "seed=1,2,-3"], sweep=True)
    with pytest.raises(UserError, match=r"no option 'simplegn'"):
        check(["image=tree.png", "generator=simplegen,simplegn"], sweep=True)


def test_group_that_the_task_does_not_need_is_checked_when_it_is_set() -> None:
    with pytest.raises(UserError, match=r"optimizer.evaluations"):
        check(["task=mask", "image=tree.png", "optimizer.evaluations=-5"], sweep=False)


def test_names_alone_can_be_checked() -> None:
    check_names([], sweep=False)
    with pytest.raises(UserError, match=r"no option 'simplegn'"):
        check_names(["generator=simplegn"], sweep=False)


@pytest.mark.parametrize("preset", sorted(path.stem for path in (CONFIG_FOLDER / "experiment").glob("*.yaml")))
def test_every_preset_is_right(preset: str) -> None:
    check(["image=tree.png", f"experiment={preset}"], sweep=False)


NEEDS_GL = "view=pyrender"
NEEDS_MORE = ("file", "external", "eztree", "modular_tree", "pyhelios")  # a path, a program or an extra
GROUPS = {
    folder.name: [f"{folder.name}={path.stem}" for path in sorted(folder.glob("*.yaml")) if path.stem not in NEEDS_MORE]
    for folder in CONFIG_FOLDER.iterdir()
    if folder.is_dir() and folder.name not in ("experiment", "hydra")
}


@pytest.mark.parametrize(
    "options", [*zip_longest(*GROUPS.values())], ids=lambda options: " ".join(filter(None, options))
)
def test_every_option_of_every_group_is_right(options: tuple[str | None, ...]) -> None:
    """One of every group at a time: each of them is built, for it was set."""
    check(["image=tree.png", *(option for option in options if option and option != NEEDS_GL)], sweep=False)


def test_the_option_that_needs_opengl_is_right() -> None:
    if missing := gl_missing():
        pytest.skip(missing)
    check(["image=tree.png", NEEDS_GL], sweep=False)


def test_mask_options_state_the_defaults_of_their_classes() -> None:
    for name in ("alpha", "sketch", "colour"):
        node = OmegaConf.load(CONFIG_FOLDER / "mask" / f"{name}.yaml")
        bare = OmegaConf.create({"_target_": node._target_})
        assert build(node, "mask") == build(bare, "mask")
