from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from experiments.score_curve import draw_score_curve, joined_means
from tests.experiments.test_search_stages import STARTS, TREE, generation


@pytest.mark.parametrize("stages", [TREE, STARTS, STARTS[:1]])
def test_the_curve_is_the_same_picture_each_time_and_as_wide_as_a_page(tmp_path: Path, stages: tuple[str, ...]) -> None:
    history = [generation(i, stage, 0.4 + 0.1 * i) for i, stage in enumerate(stages)]
    for name in ("a.png", "b.png"):
        draw_score_curve(history, "a $picture^ <b>\nby simplegen", tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert Image.open(tmp_path / "a.png").width == 900


def test_the_best_rises_to_the_right(tmp_path: Path) -> None:
    draw_score_curve([generation(i, "random", 0.2 + 0.02 * i) for i in range(30)], "t", tmp_path / "a.png")
    pixels = np.asarray(Image.open(tmp_path / "a.png").convert("RGB")).astype(int)[40:420]
    rows, columns = np.nonzero(np.abs(pixels - (0, 0x72, 0xB2)).sum(axis=2) < 30)
    left, right = rows[columns < 200], rows[(columns > 650) & (columns < 800)]
    assert left.mean() > right.mean() + 150


def test_means_of_batches_are_weighted_by_their_sizes() -> None:
    history = [generation(i, "random", 0.1 * i) for i in range(10)]
    places, means = joined_means(history, 1)
    assert places == pytest.approx([550])
    assert means == pytest.approx([np.mean([line.mean for line in history])])
    assert len(joined_means(history, 100)[0]) == 10


def test_a_search_without_a_generation_has_no_curve(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="history has no generation"):
        draw_score_curve([], "t", tmp_path / "a.png")
