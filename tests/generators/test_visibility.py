"""Every searched parameter of a generator can be seen in its mask; those that cannot are fixed and listed here."""

from __future__ import annotations

import numpy as np
import pytest

from generators.simplegen import SimpleGen
from treefit.plant import Budget, Generator, Parameter
from treefit.view import Frame, OrthographicView

UNSEEN = {"simplegen": {"branch_len_0"}, "simplegen_paper": {"branch_len_0"}}
GENERATORS: dict[str, Generator] = {"simplegen": SimpleGen(), "simplegen_paper": SimpleGen(additions=False)}


@pytest.mark.parametrize("name", GENERATORS)
def test_the_mask_sees_every_parameter_that_is_searched(name: str) -> None:
    generator = GENERATORS[name]
    unseen = {parameter.name for parameter in generator.space.parameters if not seen(generator, parameter)}
    assert {one for one in unseen if one in generator.space.names} == set()
    assert unseen & UNSEEN[name] == UNSEEN[name]


def seen(generator: Generator, parameter: Parameter) -> bool:
    """Whether the mask of one of a few random plants changes between the ends of a parameter's range."""
    rng, view = np.random.default_rng(4), OrthographicView()
    for _ in range(6):
        values = generator.space.decode(rng.random(len(generator.space)))
        masks = []
        for gene in (0.1, 0.9):
            plant = generator({**values, parameter.name: parameter.decode(gene)}, 1, Budget(20_000, 40_000))
            masks.append(view(plant, Frame(128, 4)).unpack())
        if (masks[0] != masks[1]).sum() > 20:
            return True
    return False
