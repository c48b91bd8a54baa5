import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from experiments import live_page
from experiments.live_curve import RIGHT, WIDTH, curve_svg
from experiments.live_page import Moment, data_text, embedded, page_text
from tests.experiments.test_search_stages import STARTS, TREE, generation
from treefit.improvements import Improvement

GREY = np.full((40, 30, 3), 128, np.uint8)
HISTORY = [generation(i, stage, 0.4 + 0.1 * i) for i, stage in enumerate(TREE)]
HOSTILE = "</script><script>alert(1)</script>{{state}}\u2028\"'&.png"


def facts(moment: Moment) -> dict[str, Any]:
    text = data_text(moment)
    assert text.startswith("show(")
    return dict(json.loads(text.removeprefix("show(").removesuffix(");\n")))


def test_the_data_tell_where_the_search_is() -> None:
    best = Improvement(300, 0.6, 0.7, (0.5,))
    told = facts(Moment("searching", True, 12.5, 40.0, 1000, HISTORY, embedded((GREY, GREY)), best))
    assert told["share"] == 0.5
    assert told["written"] == 12.5
    assert told["words"]["evaluations"] == "500"
    assert told["words"]["score"] == "0.8000"
    assert told["words"]["stage"] == "candidate 3"
    assert told["words"]["left"] == "5 s"
    assert told["words"]["found"] == "the best after 300: 0.600"
    assert told["picture"].startswith("data:image/jpeg;base64,")


def test_before_the_first_generation_there_is_nothing_to_tell_but_the_state() -> None:
    told = facts(Moment("growing the first trees", True))
    assert told["words"] == {"state": "growing the first trees"}
    assert "curve" not in told


def test_hostile_names_are_text_in_the_page() -> None:
    page = page_text(HOSTILE, HOSTILE, (GREY, GREY), Moment(HOSTILE, True, history=HISTORY, resume=HOSTILE))
    assert page.count("<script>") == page.count("</script>") == 3
    assert "alert(1)</script>" not in page
    assert "{{state}}" in page  # the words in the name, not filled in
    assert page.count("show({") == 1
    stages = [generation(0, '<img src=x onerror="alert(1)">, 2 x generation 0')] * 2
    assert "<img" not in curve_svg(stages, 100)


def test_the_curve_is_well_formed_and_grows_to_the_right() -> None:
    ends = []
    for count in (1, 3, 5):
        picture = ElementTree.fromstring(curve_svg(HISTORY[:count], 500))
        line = next(one for one in picture.iter("polyline") if one.get("class") == "best")
        ends.append(float((line.get("points") or "").split()[-1].split(",")[0]))
    assert ends == sorted(ends)
    assert ends[-1] == RIGHT < WIDTH


@pytest.mark.parametrize("stages", [TREE, STARTS, ("random",)])
def test_a_curve_stays_small_however_long_the_search(stages: tuple[str, ...]) -> None:
    many = [generation(i, stages[i * len(stages) // 5000], 0.5 + i // 100 / 1000) for i in range(5000)]
    assert len(curve_svg(many, 500_000)) < 12_000


def test_the_page_asks_for_nothing_from_elsewhere() -> None:
    text = Path(live_page.__file__).with_name("live.html").read_text(encoding="utf-8")
    assert "http" not in text
