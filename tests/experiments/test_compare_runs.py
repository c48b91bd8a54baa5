"""What is kept of a run of the task compare, how a search is watched, and plants as targets."""

from __future__ import annotations

import time
from dataclasses import replace
from math import inf
from pathlib import Path

import numpy as np

from experiments.compare_recorder import Record, Recorded
from experiments.compare_runs import Failed, Job, Label, Run, attempt, keep, kept
from experiments.compare_targets import hidden_targets
from generators.simplegen import SimpleGen
from generators.weberpenn import WeberPennGen
from tests.conftest import blob
from treefit.evaluation import Evaluator
from treefit.fit import fit
from treefit.plant.characteristics import Characteristics
from treefit.search import CMAES, RandomSearch
from treefit.similarity import PaperSimilarity
from treefit.view import OrthographicView

LABEL = Label("simplegen", "oak", "random", 0)
RUN = Run(LABEL, 100, (3, 10, 40), (0.1, 0.25, 0.5), 0.4, 2.0, 0.1, 1, {"levels": 2})
WISHES, VIEW = Characteristics(vertices=400), OrthographicView(resolution=64)
JOB = Job(
    LABEL, blob(64, 64), SimpleGen(), "", RandomSearch(evaluations=120, batch=50), PaperSimilarity(), WISHES, VIEW, 3, 1
)


def test_a_curve_rises_at_its_steps() -> None:
    assert [RUN.at(count) for count in (1, 3, 9, 10, 39, 40, 1000)] == [0.0, 0.1, 0.1, 0.25, 0.25, 0.5, 0.5]
    assert [RUN.reaches(score) for score in (0.05, 0.1, 0.2, 0.25, 0.5, 0.51)] == [3, 3, 10, 10, 40, inf]


def test_a_record_is_the_running_best_whatever_the_batches() -> None:
    scores = np.random.default_rng(1).random(60)
    record = Record()
    for batch in (scores[:7], scores[7:8], scores[8:]):
        record.add(batch)
    running = np.maximum.accumulate(scores)
    run = replace(RUN, steps=tuple(record.steps), scores=tuple(record.scores))
    assert [run.at(count + 1) for count in range(60)] == running.tolist()
    assert record.evaluations == 60


def test_a_watched_search_finds_the_same_and_knows_its_own_time() -> None:
    record = Record()
    strategy = CMAES(evaluations=200)
    results = [fit(JOB.target, JOB.generator, similarity=JOB.similarity, characteristics=WISHES, view=VIEW,
                   optimizer=one, evaluator=Evaluator("serial"), candidates=1, other_seeds=0)
               for one in (strategy, Recorded(strategy, record))]  # fmt: skip
    assert (results[0].candidates[0].genome == results[1].candidates[0].genome).all()
    assert [now.best for now in results[0].history] == [now.best for now in results[1].history]
    assert record.scores[-1] == results[0].history[-1].best
    assert record.evaluations == results[0].evaluations == 200
    assert 0 < record.own < record.total


def test_own_time_is_what_the_optimizer_takes_and_not_the_evaluations() -> None:
    class Slow(RandomSearch):
        def begin(self, n_genes, seed, hints=None):  # type: ignore[no-untyped-def]
            _busy(0.02)
            return super().begin(n_genes, seed, hints)

    record = Record()
    search = Recorded(Slow(evaluations=20, batch=10), record).begin(3, 0)
    while not search.done:
        genomes = search.ask()
        _busy(0.05)
        search.tell(genomes.sum(axis=1))
    assert 0.02 <= record.own < record.total - 0.09


def test_a_run_is_the_same_each_time_but_for_its_seconds() -> None:
    runs = [attempt(JOB) for _ in range(2)]
    assert all(isinstance(run, Run) for run in runs)
    one, two = (replace(run, seconds=0.0, own_seconds=0.0) for run in runs if isinstance(run, Run))
    assert one == two
    assert one.evaluations == 120
    assert one.score_other_seeds is not None


def test_a_search_that_cannot_be_done_says_why() -> None:
    found = attempt(replace(JOB, target=np.zeros((64, 64), np.uint8)))
    assert isinstance(found, Failed)
    assert "no tree" in found.reason


def test_a_kept_run_is_the_same_and_belongs_to_its_settings(tmp_path: Path) -> None:
    keep(RUN, "these", tmp_path)
    assert kept(LABEL, "these", tmp_path) == RUN
    assert kept(LABEL, "others", tmp_path) is None
    assert kept(replace(LABEL, repeat=1), "these", tmp_path) is None
    assert [file.name for file in tmp_path.rglob("*.*")] == ["random_1.json"]


def test_settings_of_a_job_change_with_all_that_it_depends_on() -> None:
    jobs = [JOB, replace(JOB, seed=4), replace(JOB, other_seeds=2), replace(JOB, target=blob(64, 64, 0.3)),
            replace(JOB, strategy=RandomSearch(evaluations=121, batch=50)), replace(JOB, generator=WeberPennGen()),
            replace(JOB, characteristics=Characteristics(vertices=401))]  # fmt: skip
    assert len({job.settings for job in jobs}) == len(jobs)
    assert replace(JOB, label=replace(LABEL, optimizer="other")).settings == JOB.settings


def test_hidden_plants_are_decent_trees_of_about_the_wished_size_and_always_the_same() -> None:
    found = [
        hidden_targets(SimpleGen(), PaperSimilarity(), Characteristics(vertices=1000), VIEW, 3, 0) for _ in range(2)
    ]
    assert list(found[0]) == ["hidden_1", "hidden_2", "hidden_3"]
    assert all((found[0][name] == found[1][name]).all() for name in found[0])
    assert all(set(np.unique(mask)) == {0, 1, 2} for mask in found[0].values())
    other = hidden_targets(SimpleGen(), PaperSimilarity(), Characteristics(vertices=1000), VIEW, 3, 1)
    assert not any((found[0][name] == other[name]).all() for name in other)


def _busy(seconds: float) -> None:
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass
