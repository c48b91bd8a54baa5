from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from experiments import best_strip
from experiments.best_strip import MOST, spread, write_best_strip
from generators.simplegen import SimpleGen
from tests.conftest import blob
from treefit.asset import AssetSettings
from treefit.fit import Result, fit
from treefit.improvements import Improvement
from treefit.mask import PALETTE
from treefit.plant.characteristics import Characteristics
from treefit.search import CMAES
from treefit.view import OrthographicView

PICTURE = np.full((256, 256, 3), (90, 120, 200), np.uint8)
_PLANT = best_strip._plant


@pytest.fixture(scope="module")
def result() -> Result:
    return fit(blob(256, 256), SimpleGen(), optimizer=CMAES(evaluations=200), view=OrthographicView(resolution=64),
               characteristics=Characteristics(vertices=300), other_seeds=0, candidates=1)  # fmt: skip


def found(evaluations: int) -> Improvement:
    return Improvement(evaluations, evaluations / 1e6, 0.5, (0.5,))


def test_the_plants_of_a_strip_are_spread_by_the_logarithm_of_evaluations() -> None:
    known = [found(evaluations) for evaluations in range(100, 50_000, 100)]
    chosen = [one.evaluations for one in spread(known, MOST)]
    assert len(chosen) == MOST
    assert (chosen[0], chosen[-1]) == (100, 49_900)
    ratios = np.array(chosen[1:]) / chosen[:-1]
    assert ratios.max() / ratios.min() < 1.5


@pytest.mark.parametrize("count", [1, 2, MOST - 1, MOST])
def test_few_improvements_are_all_shown(count: int) -> None:
    known = [found(100 + i) for i in range(count)]
    assert spread(known, MOST) == known


def test_there_are_as_many_as_may_be_where_they_are_crowded() -> None:
    known = [found(100), *(found(9_000 + 100 * i) for i in range(30))]
    chosen = spread(known, MOST)
    assert MOST - 2 <= len(chosen) <= MOST
    assert (chosen[0], chosen[-1]) == (known[0], known[-1])


def test_a_strip_shows_pictures_and_masks_and_is_the_same_each_time(tmp_path: Path, result: Result) -> None:
    for name in ("a.png", "b.png"):
        write_best_strip(tmp_path / name, result, PICTURE, AssetSettings(), "a\n<picture>")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    page = np.asarray(Image.open(tmp_path / "a.png"))
    colours, counts = np.unique(page.reshape(-1, 3), axis=0, return_counts=True)
    known = {tuple(colour): count for colour, count in zip(colours.tolist(), counts.tolist(), strict=True)}
    assert known[90, 120, 200] > 10_000
    assert known[PALETTE[2]] > 5_000 * len(spread(result.improvements, MOST))


def test_a_plant_that_cannot_be_drawn_leaves_its_reason_in_the_strip(
    tmp_path: Path, result: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []
    monkeypatch.setattr(best_strip, "drawn_panels", lambda *_: 1 / 0)
    monkeypatch.setattr(best_strip, "put_reason", lambda page, reason, *place: told.append(reason))
    write_best_strip(tmp_path / "a.png", result, PICTURE, AssetSettings(), "t")
    assert set(told) == {"not drawn: division by zero"}


def test_a_plant_that_cannot_be_grown_again_is_left_out_of_the_strip(
    tmp_path: Path, result: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    lost, names = spread(result.improvements, MOST)[0], list[str]()
    page = best_strip._page

    def heard(columns: object, words: list[tuple[str, str]], *rest: object) -> Image.Image:
        names.extend(name for name, _ in words)
        return page(columns, words, *rest)

    monkeypatch.setattr(best_strip, "_page", heard)
    monkeypatch.setattr(best_strip, "_plant", lambda all, one: "no answer" if one is lost else _PLANT(all, one))
    write_best_strip(tmp_path / "a.png", result, PICTURE, AssetSettings(), "t")
    shown = [f"after {one.evaluations:,}" for one in spread(result.improvements, MOST) if one is not lost]
    assert names == ["the picture", *shown]
    monkeypatch.setattr(best_strip, "_plant", lambda all, one: "no answer")
    write_best_strip(tmp_path / "b.png", result, PICTURE, AssetSettings(), "t")
    assert (tmp_path / "b.png").is_file()
