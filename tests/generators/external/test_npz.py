"""Npz files are read and written as numpy does it, only faster; what is none is refused before it is loaded."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generators.external.arrays import FIELDS, plant_of
from generators.external.faults import TooLarge
from generators.external.npz import read_npz
from generators.external.npz_writer import write_npz

TREE = {
    "position": np.arange(12, dtype=np.float32).reshape(4, 3), "parent": np.array([-1, 0, 1, 1], np.int32),
    "radius": np.linspace(1, 0.1, 4), "leaf_size": np.asfortranarray(np.arange(6, dtype=np.float32).reshape(3, 2)),
    "complexity": np.asarray(17.5), "leaf_axis": np.zeros((0, 3), np.float32),
}  # fmt: skip


def test_what_is_written_is_what_numpy_reads(tmp_path: Path) -> None:
    write_npz(str(tmp_path / "tree.npz"), TREE)
    with np.load(tmp_path / "tree.npz", allow_pickle=False) as content:
        assert set(content) == set(TREE)
        for name, array in TREE.items():
            np.testing.assert_array_equal(content[name], array)
            assert content[name].dtype == array.dtype


@pytest.mark.parametrize("save", [np.savez, np.savez_compressed, lambda path, **arrays: write_npz(str(path), arrays)])
@pytest.mark.parametrize("order", ["C", "F"])
def test_what_numpy_writes_is_read(tmp_path: Path, save: object, order: str) -> None:
    arrays = {name: np.asarray(array, order=order) for name, array in TREE.items()}
    save(tmp_path / "tree.npz", other=np.ones(3), **arrays)  # type: ignore[operator]
    found = read_npz(tmp_path / "tree.npz", 100)
    assert set(found) == set(TREE) <= set(FIELDS)
    for name, array in TREE.items():
        np.testing.assert_array_equal(found[name], array)


def test_same_arrays_are_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        write_npz(str(tmp_path / name), TREE)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()


def test_too_many_rows_are_refused_by_the_header_alone(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "tree.npz", position=np.zeros((1_000_000, 3), np.float32))
    with pytest.raises(TooLarge, match=r"position has 1,000,000 rows, over generator\.max_vertices=1000"):
        read_npz(tmp_path / "tree.npz", 1000)


@pytest.mark.parametrize(
    "array", [np.array([{}, []], object), np.array(["a", "b"]), np.zeros((2, 2, 2)), np.zeros((2, 4)),
              np.zeros(2, [("x", "f4")])],
)  # fmt: skip
def test_what_is_no_array_of_a_tree_is_refused(tmp_path: Path, array: np.ndarray) -> None:
    np.savez(tmp_path / "tree.npz", position=array)
    with pytest.raises(ValueError, match="position"):
        plant_of({**TREE, **read_npz(tmp_path / "tree.npz", 100)})


def test_objects_are_not_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="must be numbers, got object"):
        write_npz(str(tmp_path / "tree.npz"), {"position": np.array([{}], object)})
