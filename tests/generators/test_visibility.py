"""Every searched parameter of a generator can be seen in its mask; those that cannot are fixed and listed here."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from tests.generators.test_contract import GENERATORS
from treefit.plant import Budget, Generator, Parameter, Plant, Values
from treefit.view import Frame, OrthographicView

LOOK = {"lobes", "lobe_depth", "leaf_shape"}
UNSEEN = {
    "simplegen": {"branch_len_0"}, "simplegen_paper": {"branch_len_0"}, "weberpenn": LOOK, "weberpenn_full": LOOK,
    "gegen": {"internode", "leaf_shape"},
}  # fmt: skip
BUDGET = Budget(12_000, 24_000)
RANDOM = 6
COARSE: dict[str, Values] = {
    "weberpenn": {
        "levels": 4, "ratio": 0.05, "ratio_power": 0.8, "leaves": 3, "leaf_scale": 0.5, "prune_ratio": 0.5,
        **{f"branches_{n}": 5 for n in (1, 2, 3)}, **{f"length_{n}": 0.6 for n in (1, 2, 3)},
        **{f"down_angle_{n}": 30 for n in (1, 2, 3)}, **{f"split_angle_{n}": 80 for n in range(4)},
        **{f"curve_res_{n}": 4 for n in range(4)}, **{f"seg_splits_{n}": 0.3 for n in range(4)},
    },
}  # fmt: skip


@pytest.mark.parametrize("name", GENERATORS)
def test_the_mask_sees_every_parameter_that_is_searched(name: str) -> None:
    generator = GENERATORS[name]
    unseen = {parameter.name for parameter in generator.space.parameters if not seen(generator, parameter)}
    assert {one for one in unseen if one in generator.space.names} == set()
    assert unseen & UNSEEN[name] == UNSEEN[name]


def seen(generator: Generator, parameter: Parameter) -> bool:
    """Whether the mask of one of a few plants changes between the ends of a parameter's range."""
    for values in samples(generator):
        one, two = (mask(generator, {**values, parameter.name: parameter.decode(gene)}) for gene in (0.1, 0.9))
        if (one != two).sum() > 20:
            return True
    return False


def samples(generator: Generator) -> Iterator[Values]:
    """Values of a plant of few but thick stems, of presets and random ones."""
    yield generator.space.complete(COARSE.get(generator.name, {}))
    for preset in generator.presets.values():
        yield generator.space.complete(preset.values)
    rng = np.random.default_rng(4)
    for _ in range(RANDOM):
        yield generator.space.decode(rng.random(len(generator.space)))


def mask(generator: Generator, values: Values) -> np.ndarray:
    plant: Plant = generator(values, 1, BUDGET)
    return OrthographicView()(plant, Frame(128, 4)).unpack()
