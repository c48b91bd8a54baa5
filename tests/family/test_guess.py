"""Guess: what a network tells of the genome, its file, and which one a search finds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from tests.family.counted import Counted
from treefit.family.files import read_arrays, write_arrays
from treefit.family.guess import UNKNOWN, Guess, find_guess, learn_guess
from treefit.family.identity import FamilyError, StaleError
from treefit.family.network import Training
from treefit.plant import ParameterSpace

GENERATOR = SimpleGen()
SPACE = GENERATOR.space
N, F = len(SPACE), 5


def learnt(seed: int = 0) -> Guess:
    """Guess from plants whose features say the first genes, and whose other genes go together by pairs."""
    rng = np.random.default_rng(seed)
    genomes = rng.random((1200, N))
    genomes[:, 11] = genomes[:, 10]
    features = (genomes[:, :F] + 0.01 * rng.standard_normal((1200, F))).astype(np.float16)
    vertices = rng.integers(50, 5000, 1200).astype(np.int32)
    return learn_guess(GENERATOR, SPACE, genomes, features, vertices, 0, Training((16,), 24, 64))


GUESS = learnt()
LOOK = np.linspace(0.1, 0.9, F, dtype=np.float32)


def test_what_the_look_tells_is_guessed_closely_and_the_rest_as_widely_as_nothing_is_known() -> None:
    mean, deviation = GUESS(LOOK, 1000)
    np.testing.assert_allclose(mean[:F], LOOK, atol=0.1)
    assert deviation[:F].max() < 0.5 * deviation[F:].min()
    np.testing.assert_allclose(deviation[F:], UNKNOWN, atol=0.06)
    assert GUESS.missed < -0.74
    assert GUESS.correlation[10, 11] > 0.8 > 0.3 > abs(GUESS.correlation[10, 12])


def test_no_wish_for_vertices_is_the_mean_of_all_and_features_never_seen_are_held_back() -> None:
    wished = float(np.exp(GUESS.middle[-1]))
    np.testing.assert_allclose(GUESS(LOOK, None), GUESS(LOOK, wished), atol=1e-6)
    np.testing.assert_array_equal(GUESS(LOOK * 1e6, None)[0], GUESS(LOOK * 1e9, None)[0])


def test_the_same_seed_learns_the_same_bytes(tmp_path: Path) -> None:
    for name, guess in (("one", GUESS), ("again", learnt()), ("other", learnt(1))):
        guess.write(tmp_path / name)
    one, again, other = ((tmp_path / name).read_bytes() for name in ("one", "again", "other"))
    assert one == again != other


def test_a_guess_out_of_its_file_tells_the_same_and_is_written_as_the_same_file(tmp_path: Path) -> None:
    GUESS.write(tmp_path / "new" / "guess.npz")
    read = Guess.read(tmp_path / "new" / "guess.npz")
    assert (read.generator, read.version, read.genes) == (GUESS.generator, GUESS.version, GUESS.genes)
    assert read.missed == GUESS.missed
    for found, wanted in zip(read(LOOK, 1000), GUESS(LOOK, 1000), strict=True):
        np.testing.assert_allclose(found, wanted, atol=3e-3)
    read.write(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == (tmp_path / "new" / "guess.npz").read_bytes()
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["again.npz", "guess.npz", "new"]


HEAD: Mapping[str, Any] = {
    "no layers": {"layers": 0}, "another format": {"format": 7}, "no genes": {"genes": []},
    "more layers": {"layers": 9}, "twice the same gene": {"genes": [{"name": "levels"}] * N},
    "layers in words": {"layers": "two"},
}  # fmt: skip
ARRAYS: Mapping[str, Callable[[dict[str, Any]], object]] = {
    "other numbers": lambda arrays: arrays.update(middle=arrays["middle"].astype(float)),
    "not a number": lambda arrays: arrays["weights_0"].fill(np.nan),
    "no width": lambda arrays: arrays["width"].fill(0),
    "infinite width": lambda arrays: arrays["width"].fill(np.inf),
    "too few features": lambda arrays: arrays.update(middle=arrays["middle"][1:], width=arrays["width"][1:]),
    "too few genes": lambda arrays: arrays.update(correlation=arrays["correlation"][1:, 1:]),
    "offsets in rows": lambda arrays: arrays.update(offsets_0=np.ones((16, 2), np.float16)),
    "a part is missing": lambda arrays: arrays.pop("offsets_1"),
}


@pytest.mark.parametrize("change", [*HEAD, *ARRAYS])
def test_a_file_with_something_wrong_in_it_is_refused_in_one_line(tmp_path: Path, change: str) -> None:
    path = tmp_path / "guess.npz"
    GUESS.write(path)
    head, arrays = read_arrays(path, "guess", lambda head, arrays: (head, {**arrays}))
    arrays = {name: array.copy() for name, array in arrays.items()}
    ARRAYS.get(change, lambda arrays: None)(arrays)
    write_arrays(path, {**head, **HEAD.get(change, {})}, arrays)
    _refused(path)


@pytest.mark.parametrize("length", [0, 10, 1000, -1000, -1])
def test_a_file_that_was_cut_is_refused_in_one_line(tmp_path: Path, length: int) -> None:
    path = tmp_path / "guess.npz"
    GUESS.write(path)
    path.write_bytes(path.read_bytes()[:length])
    _refused(path)


def _refused(path: Path) -> None:
    with pytest.raises(FamilyError, match=r"^guess .*guess\.npz: damaged \(.+\); delete the file$") as caught:
        find_guess(Counted(family=path.parent))
    assert "\n" not in str(caught.value)


def test_without_a_file_or_folder_there_is_no_guess(tmp_path: Path) -> None:
    assert find_guess(Counted(family=None)) is None
    assert find_guess(Counted(family=tmp_path / "none")) is None
    (tmp_path / "statistics.npz").write_bytes(b"of somebody else")
    assert find_guess(Counted(family=tmp_path)) is None


def test_a_guess_of_another_version_or_range_is_refused_with_the_command_that_renews_it(tmp_path: Path) -> None:
    command = "renew them: python run.py task=statistics generator=simplegen statistics.renew=true$"
    replace(GUESS, version="0").write(tmp_path / "guess.npz")
    with pytest.raises(StaleError, match=rf"guess\.npz is of version 0, the generator of 2; {command}"):
        find_guess(Counted(family=tmp_path))
    wider = tuple({**gene, "high": 7.0} if gene["name"] == "lean" else gene for gene in GUESS.genes)
    replace(GUESS, genes=wider).write(tmp_path / "guess.npz")
    with pytest.raises(StaleError, match=rf"parameter 'lean' has another range than in guess\.npz; {command}"):
        find_guess(Counted(family=tmp_path))
    with pytest.raises(StaleError, match=f"parameter 'lean' has another range now; {command}"):
        replace(GUESS, genes=wider).for_space(SPACE, LOOK, None)


def test_features_that_are_not_those_of_the_guess_are_refused() -> None:
    with pytest.raises(StaleError, match=r"4 features of a mask now, 5 then; renew them"):
        GUESS.for_space(SPACE, LOOK[1:], None)


def test_of_a_parameter_that_it_does_not_know_nothing_is_known() -> None:
    space = SPACE.release("branch_len_0")
    mean, deviation, correlation = GUESS.for_space(space, LOOK, 1000)
    at = space.names.index("branch_len_0")
    assert (mean[at], deviation[at]) == (0.5, UNKNOWN)
    np.testing.assert_array_equal(correlation[at], np.arange(N + 1) == at)
    kept = np.arange(N + 1) != at
    np.testing.assert_array_equal([mean[kept], deviation[kept]], GUESS(LOOK, 1000))


def test_what_is_told_follows_the_order_of_the_genes() -> None:
    turned = ParameterSpace(SPACE.parameters[::-1], SPACE.fixed)
    mean, deviation, correlation = GUESS.for_space(SPACE, LOOK, 1000)
    back = GUESS.for_space(turned, LOOK, 1000)
    for found, wanted in zip(back, (mean[::-1], deviation[::-1], correlation[::-1, ::-1]), strict=True):
        np.testing.assert_array_equal(found, wanted)
    assert np.ptp(mean) > 0.3
