"""Statistics of the family: marks by hand, files that are whole or refused, and which genes they are for."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from generators.simplegen.parameters import SPACE
from tests.family.counted import statistics
from treefit.family.identity import FamilyError, StaleError
from treefit.family.statistics import WORST, Statistics
from treefit.plant import ParameterSpace

SPACE_OF = SimpleGen().space


def test_marks_are_as_the_paper_and_as_its_authors_have_them() -> None:
    found = statistics(
        tried=np.tile([100, 100, 100], (len(SPACE_OF), 1)), above=np.tile([30, 15, 45], (len(SPACE_OF), 1))
    )
    assert found.p0 == pytest.approx(0.3)
    np.testing.assert_allclose(found.quality("paper")[0], [0.0, -2.0, 1.5])
    np.testing.assert_allclose(found.quality("continuous")[0], [0.0, -1.0, 0.5])


@pytest.mark.parametrize("mark", ["paper", "continuous"])
def test_marks_are_finite_where_nothing_good_was_found_or_nothing_tried(mark: str) -> None:
    n = len(SPACE_OF)
    found = statistics(tried=np.tile([5000, 0, 10], (n, 1)), above=np.tile([0, 0, 10], (n, 1)))
    np.testing.assert_array_equal(found.quality(mark)[0], [-WORST, 0.0, WORST])  # type: ignore[arg-type]
    none = statistics(above=np.zeros((n, 2), np.int64))
    assert not none.quality(mark).any()  # type: ignore[arg-type]


def test_a_file_gives_back_what_was_written(tmp_path: Path) -> None:
    found = statistics()
    found.write(tmp_path / "new" / "statistics.npz")
    read = Statistics.read(tmp_path / "new" / "statistics.npz")
    for field in fields(Statistics):
        one, two = getattr(found, field.name), getattr(read, field.name)
        assert (one == two).all() and one.dtype == two.dtype if isinstance(one, np.ndarray) else one == two
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["statistics.npz"]


@pytest.mark.parametrize(
    ("name", "value", "why"),
    [
        ("rate", np.full(len(SPACE_OF), np.nan), "rates must be finite"),
        ("rate", np.full(len(SPACE_OF), -1.0), "rates must be finite and not negative"),
        ("rate", np.ones(3), "rate and steps must be of"),
        ("rate", np.ones(len(SPACE_OF), np.float32), "rate must be float64"),
        ("rate", np.array([None] * len(SPACE_OF)), "pickle"),
        ("steps", np.full(len(SPACE_OF), -1), "not negative"),
        ("above", np.tile([2, 51], (len(SPACE_OF), 1)), r"above must be in \[0, tried\]"),
        ("above", np.tile([-2, 8], (len(SPACE_OF), 1)), r"above must be in \[0, tried\]"),
        ("above", np.ones((2, 2), np.int64), "must have the shape"),
        ("tried", np.vstack([[60, 50], np.tile([50, 50], (len(SPACE_OF) - 1, 1))]), "in the same evaluations"),
        ("eps", np.array([np.inf]), "eps must be a finite number"),
        ("head", np.frombuffer(b'{"format": 99}', np.uint8), "format 99"),
        ("head", np.frombuffer(b"{", np.uint8), "damaged"),
    ],
)
def test_a_file_with_a_wrong_array_is_refused_in_one_line(
    tmp_path: Path, name: str, value: np.ndarray, why: str
) -> None:
    path = tmp_path / "statistics.npz"
    statistics().write(path)
    with np.load(path) as file:
        arrays = {**file, name: value}
    np.savez(path, allow_pickle=True, **arrays)
    with pytest.raises(FamilyError, match=why) as error:
        Statistics.read(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("kept", [0, 10, 1000])
def test_a_file_that_is_not_whole_is_refused(tmp_path: Path, kept: int) -> None:
    path = tmp_path / "statistics.npz"
    statistics().write(path)
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(FamilyError, match=r"damaged .*; delete the file"):
        Statistics.read(path)


def test_rates_and_marks_are_in_the_order_of_the_genes_of_a_space() -> None:
    names = SPACE_OF.names
    turned = ParameterSpace(SPACE.parameters[::-1], {**SPACE_OF.fixed, names[3]: SPACE_OF.free[3].default})
    rate, quality = statistics().for_space(turned)
    np.testing.assert_array_equal(rate, [names.index(name) for name in turned.names])
    assert quality.shape == (len(turned), 2)


def test_a_gene_that_is_not_known_has_the_mean_rate_and_no_marks() -> None:
    found = statistics()
    space = SPACE_OF.release("branch_len_0")
    rate, quality = found.for_space(space, "paper")
    at = space.names.index("branch_len_0")
    assert rate[at] == found.rate.mean()
    assert not quality[at].any()
    np.testing.assert_array_equal(np.delete(quality, at, axis=0), found.quality("paper"))


@pytest.mark.parametrize("change", [{"high": 1e6}, {"kind": "float"}, {"scale": "log", "low": 1.5}])
def test_a_gene_of_another_range_or_kind_makes_the_statistics_stale(change: dict[str, object]) -> None:
    known = statistics().genes
    changed = ParameterSpace(
        tuple(replace(one, **change) if one.name == "branch_count_0" else one for one in SPACE.parameters),
        SPACE_OF.fixed,  # type: ignore[arg-type]
    )
    assert any(one["name"] == "branch_count_0" for one in known)
    with pytest.raises(StaleError, match=r"'branch_count_0' has another range.*task=statistics generator=simplegen"):
        statistics().for_space(changed)
