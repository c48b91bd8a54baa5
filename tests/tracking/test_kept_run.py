from pathlib import Path

import pytest

from treefit.tracking.kept_run import FILE, read_run, run_of, write_run


def test_folder_knows_its_run_of_a_store_and_an_experiment(tmp_path: Path) -> None:
    assert read_run(tmp_path, "sqlite:///a", "e") is None
    write_run(tmp_path, "sqlite:///a", "e", "0123")
    assert read_run(tmp_path, "sqlite:///a", "e") == run_of(tmp_path) == "0123"
    assert read_run(tmp_path, "sqlite:///b", "e") is read_run(tmp_path, "sqlite:///a", "f") is None


@pytest.mark.parametrize("text", ["", "[]", "{}", "null", '{"store": 1'])
def test_damaged_file_is_no_run(tmp_path: Path, text: str) -> None:
    (tmp_path / FILE).write_text(text)
    assert read_run(tmp_path, "sqlite:///a", "e") is run_of(tmp_path) is None
