import json
from dataclasses import asdict
from itertools import pairwise

from treefit.improvements import SPANS, Improvement, joined


def found(evaluations: int) -> Improvement:
    return Improvement(evaluations, evaluations / 1e6, 0.5, (0.25, 1 / 3))


def test_of_a_span_of_evaluations_the_last_improvement_is_kept() -> None:
    kept: list[Improvement] = []
    for evaluations in range(1, 50_001):
        kept = joined(kept, found(evaluations))
    spans = [one.span for one in kept]
    assert spans == sorted(set(spans))
    assert len(kept) <= SPANS * 16
    assert kept[-1] == found(50_000)
    assert all(later.evaluations <= 1.5 * one.evaluations for one, later in pairwise(kept[3:]))


def test_improvements_that_are_far_apart_are_all_kept() -> None:
    kept: list[Improvement] = []
    for power in range(10):
        kept = joined(kept, found(100 * 2**power))
    assert [one.evaluations for one in kept] == [100 * 2**power for power in range(10)]


def test_an_improvement_comes_back_from_json() -> None:
    assert Improvement.from_json(json.loads(json.dumps(asdict(found(7))))) == found(7)
