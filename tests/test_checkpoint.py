from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from treefit.checkpoint import CheckpointError, read_checkpoint, write_checkpoint

ARRAYS = {"genomes": np.arange(12.0).reshape(3, 4), "counters": np.array([1, 2])}
META = {"fingerprint": "é", "progress": [1, {"a": None}]}


def test_what_is_written_is_read(tmp_path: Path) -> None:
    write_checkpoint(tmp_path / "c.npz", ARRAYS, META)
    arrays, meta = read_checkpoint(tmp_path / "c.npz")
    assert meta == META
    assert {name: array.tolist() for name, array in arrays.items()} == {n: a.tolist() for n, a in ARRAYS.items()}
    assert [file.name for file in tmp_path.iterdir()] == ["c.npz"]


def test_a_cut_or_flipped_checkpoint_is_told_or_whole(tmp_path: Path) -> None:
    path, rng = tmp_path / "c.npz", np.random.default_rng(0)
    write_checkpoint(path, ARRAYS, META)
    whole, told = path.read_bytes(), []
    for _ in range(150):
        data = bytearray(whole)
        if rng.random() < 0.5:
            data = data[: rng.integers(0, len(data))]
        else:
            data[rng.integers(0, len(data))] ^= 1 << rng.integers(0, 8)
        path.write_bytes(bytes(data))
        try:
            arrays, meta = read_checkpoint(path)
        except CheckpointError as error:
            told.append(str(error))
            continue
        assert meta == META
        assert all((arrays[name] == ARRAYS[name]).all() for name in ARRAYS)
    assert len(told) > 50
    assert not any("\n" in line for line in told)


def test_a_missing_checkpoint_is_not_a_damaged_one(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        read_checkpoint(tmp_path / "c.npz")
