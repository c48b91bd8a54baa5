"""Every optimiser of the configuration, and every kind of generator space, in a fit that is killed and goes on."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from omegaconf import OmegaConf

from experiments.build import build
from generators.simplegen import SimpleGen
from tests.conftest import blob
from tests.search.settings import CONF, OPTIMIZERS, kind, settings
from treefit.fit import Result, fit
from treefit.plant.characteristics import Characteristics
from treefit.progress import Failure, Generation
from treefit.view import OrthographicView

TARGET = blob(256, 256)
SMALL: dict[str, dict[str, int]] = {
    "cma_es": {"min_population": 16, "generations": 10}, "treefit": {}, "random": {"batch": 40},
    "cma": {"population": 16}, "de": {"population": 20}, "lshade": {"population": 20},
    "tree_ga": {"population": 16, "start_population": 20, "generations": 5},
    "tree_ga_authors": {"population": 16, "start_population": 20, "generations": 5},
    "ga": {"population": 20, "start_population": 20},
}  # fmt: skip
"""Settings that make many generations of a small budget."""


def small(name: str, generator: Any = None, **changes: Any) -> Result:
    strategy = kind(name)(**{**settings(name), **SMALL[name], "evaluations": 260})
    return fit(
        TARGET, generator or SimpleGen(), optimizer=strategy, view=OrthographicView(resolution=64),
        characteristics=Characteristics(vertices=400), other_seeds=0, **changes,
    )  # fmt: skip


def outcome(result: Result) -> list[object]:
    """Everything of a result but times."""
    found = [(candidate.genome.tobytes(), candidate.score) for candidate in result.candidates]
    lines = ((line.evaluations, line.best, line.mean, line.stage) for line in result.history)
    return [*found, *lines, *result.improvements]


def kill(generation: Generation, failures: list[Failure]) -> None:
    if generation.number == 4:
        raise KeyboardInterrupt


def test_every_optimizer_of_the_configuration_is_tried() -> None:
    assert set(SMALL) == set(OPTIMIZERS)


@pytest.mark.parametrize("name", OPTIMIZERS)
def test_a_killed_fit_goes_on_to_the_same_bytes_with_every_optimizer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.setattr(sys.modules["treefit.fit"], "CHECKPOINT_SECONDS", 0.0)
    with pytest.raises(KeyboardInterrupt):
        small(name, checkpoint=tmp_path / "c.npz", on_generation=kill)
    first: list[int] = []
    resumed = small(name, checkpoint=tmp_path / "c.npz", on_generation=lambda now, _: first.append(now.number))
    whole = small(name)
    assert first[0] == 5
    assert outcome(resumed) == outcome(whole)
    assert whole.evaluations == 260


@pytest.mark.parametrize("name", ["weberpenn_full", "simplegen_paper"])
def test_a_generator_of_which_less_or_nothing_was_counted_is_fitted_too(name: str) -> None:
    generator = build(OmegaConf.load(CONF.parent / "generator" / f"{name}.yaml"), "generator")
    result = small("treefit", generator)
    assert result.history[-1].best > 0.1
