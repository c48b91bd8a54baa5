"""The shape of the house: who may import whom, how long a file is, which names are banned."""

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
ROOMS = ("treefit", "generators", "experiments", "scripts", "tests")
FILES = sorted(path for room in ROOMS for path in (ROOT / room).rglob("*.py") if "node_modules" not in path.parts)
FILES.append(ROOT / "run.py")
LONGEST = 250
BANNED_NAMES = ("util", "utils", "helper", "helpers", "misc", "common", "tools", "stuff")
BANNED_CALLS = ("np.random.seed", "random.seed", "numpy.random.seed", "np.random.rand", "random.random", "pickle.load")


def name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@cache
def imported(path: Path) -> list[str]:
    """Modules that a file imports anywhere in it."""
    found: list[str] = []
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.Import):
            found += (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name(path)}: imports are absolute"
            found.append(str(node.module))
    return found


@cache
def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def within(room: str) -> list[Path]:
    return [path for path in FILES if f"{name(path)}/".startswith(room)]


def forbid(paths: list[Path], *modules: str) -> None:
    found = [f"{name(path)} imports {module}" for path in paths for module in imported(path) if _is(module, modules)]
    assert found == []


def _is(module: str, modules: tuple[str, ...]) -> bool:
    return any(module == banned or module.startswith(f"{banned}.") for banned in modules)


def test_the_method_knows_neither_configuration_nor_generators() -> None:
    forbid(within("treefit/"), "hydra", "omegaconf", "generators", "experiments", "run")


def test_generators_know_only_plants() -> None:
    foreign = {
        f"{name(path)} imports {module}"
        for path in within("generators/")
        for module in imported(path)
        if _is(module, ("treefit", "experiments")) and not _is(module, ("treefit.plant",))
    }
    assert foreign == set()


def test_the_search_knows_nothing_of_the_rest() -> None:
    foreign = {
        f"{name(path)} imports {module}"
        for path in within("treefit/search/")
        for module in imported(path)
        if _is(module, ("treefit",)) and not _is(module, ("treefit.search",))
    }
    assert foreign == set()


def test_models_and_files_know_nothing_of_views_and_searches() -> None:
    above = ("view", "similarity", "search", "family", "image", "tracking", "objective", "evaluation", "fit")
    forbid(within("treefit/asset/"), *(f"treefit.{room}" for room in above))


def test_only_one_room_knows_each_foreign_system() -> None:
    code = [path for path in FILES if not name(path).startswith("tests/")]
    forbid([path for path in code if not name(path).startswith("treefit/tracking/")], "mlflow")
    forbid([path for path in code if name(path) != "treefit/evaluation.py"], "joblib")
    forbid([path for path in code if not name(path).startswith(("experiments/", "run.py"))], "hydra", "omegaconf")


def test_mlflow_is_imported_in_one_file_and_only_when_it_is_used() -> None:
    for path in within("treefit/tracking/"):
        top = parsed(path).body
        at_start = [node.module for node in top if isinstance(node, ast.ImportFrom)]
        assert not [module for module in at_start if _is(str(module), ("mlflow",))], name(path)
    users = {name(path) for path in within("treefit/tracking/") if any(_is(m, ("mlflow",)) for m in imported(path))}
    assert users == {"treefit/tracking/mlflow_run.py"}


def test_run_is_short_and_knows_only_the_experiments() -> None:
    run = ROOT / "run.py"
    assert len(run.read_text(encoding="utf-8").splitlines()) <= 30
    forbid([run], "treefit", "generators")


def test_nothing_imports_the_entry_or_the_tests() -> None:
    forbid([path for path in FILES if not name(path).startswith("tests/")], "run", "tests")


def test_every_file_has_one_idea() -> None:
    assert {name(path): fault for path in FILES if (fault := _fault(path))} == {}


def _fault(path: Path) -> str:
    """What a file has that none should, "" when it is fine."""
    tree = parsed(path)
    calls = {ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)} & set(BANNED_CALLS)
    faults = {
        f"is longer than {LONGEST} lines": len(path.read_text(encoding="utf-8").splitlines()) > LONGEST,
        "has a name that says nothing": path.stem in BANNED_NAMES,
        "does not begin with a sentence on its place": not name(path).startswith("tests/")
        and not ast.get_docstring(tree),
        f"calls {', '.join(calls)}": bool(calls),
    }
    return "; ".join(words for words, there in faults.items() if there)
