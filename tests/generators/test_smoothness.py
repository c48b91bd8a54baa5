"""What a search can climb: near genomes have near scores, for every generator whose random plants are seldom cut."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import spearmanr

from tests.conftest import blob
from tests.generators.test_contract import GENERATORS
from treefit.fit import aim
from treefit.plant.characteristics import Characteristics
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView


@pytest.mark.parametrize("name", ["simplegen", "weberpenn", "gegen"])
def test_a_small_step_changes_the_score_a_little(name: str) -> None:
    wishes = Characteristics(vertices=None)
    objective = aim(blob(256, 256), GENERATORS[name], PaperSimilarity(), wishes, OrthographicView(), 0)
    rng = np.random.default_rng(1)
    genomes = rng.random((150, len(objective.space)))
    step = rng.standard_normal(genomes.shape)
    step *= 0.01 / np.linalg.norm(step, axis=1, keepdims=True)
    scores = [[objective(genome).image for genome in part] for part in (genomes, np.clip(genomes + step, 0, 1))]
    assert spearmanr(*scores).statistic > 0.95
