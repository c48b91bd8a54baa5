"""What is known before a search: the plants that it begins from, and the generator's own."""

from __future__ import annotations

import numpy as np
import pytest

from generators.weberpenn import WeberPennGen
from tests.conftest import blob
from treefit.family.hints import hints_of
from treefit.fit import aim
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

GENERATOR = WeberPennGen()
OBJECTIVE = aim(blob(), GENERATOR, PaperSimilarity(), Characteristics(), OrthographicView(), 0)


def test_the_plants_to_begin_from_come_before_those_of_the_generator() -> None:
    own = [preset.values for preset in GENERATOR.presets.values()]
    known = hints_of(OBJECTIVE, blob(), [own[3], {}]).known
    wanted = [own[3], {}, *own]
    np.testing.assert_array_equal(known, [OBJECTIVE.space.encode(values) for values in wanted])


def test_a_start_with_a_parameter_that_the_generator_lacks_is_named() -> None:
    with pytest.raises(
        ValueError, match="start 2 of generator 'weberpenn': no parameter 'levls'; did you mean 'levels'"
    ):
        hints_of(OBJECTIVE, blob(), [{}, {"levls": 2}])
