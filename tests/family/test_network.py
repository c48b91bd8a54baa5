"""The small network: its gradients, what it learns, and that it learns the same again."""

from __future__ import annotations

import numpy as np
import pytest

from treefit.family.network import NARROWEST, WIDEST, Layer, Training, _begin, _gradients, loss, predict, train

SMALL = Training(hidden=(24, 24), epochs=40, batch=64, rate=5e-3)


def pairs(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Inputs (m, 3), and outputs (m, 2) that are bent functions of them with normal errors of 0.05 and 0.05 or 0.15."""
    rng = np.random.default_rng(seed)
    inputs = rng.standard_normal((count, 3)).astype(np.float32)
    errors = rng.standard_normal((count, 2)) * deviations(inputs)
    return inputs, (means(inputs) + errors).astype(np.float32)


def means(inputs: np.ndarray) -> np.ndarray:
    return np.column_stack([0.5 + 0.2 * np.tanh(inputs[:, 0]), 0.5 + 0.2 * np.sin(inputs[:, 1])])


def deviations(inputs: np.ndarray) -> np.ndarray:
    return np.column_stack([np.full(len(inputs), 0.05), np.where(inputs[:, 2] > 0, 0.15, 0.05)])


def layers(f: int = 4, n: int = 3, width: float = 1.0) -> list[Layer]:
    """Network in numbers of eight bytes, whose logarithms of deviations are about -1 +- `width`."""
    rng = np.random.default_rng(1)
    found = [(rng.standard_normal((a, b)) / a**0.5, rng.standard_normal(b) * 0.1) for a, b in [(f, 7), (7, 5)]]
    last = rng.standard_normal((5, 2 * n))
    last[:, n:] *= width
    return [*found, (last, np.repeat([0.5, -1.0], n))]


@pytest.mark.parametrize("width", [1.0, 10.0])
def test_gradients_are_the_numerical_ones_also_where_deviations_are_at_their_limits(width: float) -> None:
    rng = np.random.default_rng(2)
    network, inputs, wanted = layers(width=width), rng.standard_normal((9, 4)), rng.random((9, 3))
    logs = np.log(predict(network, inputs)[1])
    assert (np.isclose(logs, NARROWEST) | np.isclose(logs, WIDEST)).any() == (width > 1)
    arrays, numerical = [array for layer in network for array in layer], []
    for array in arrays:
        slopes = np.empty_like(array)
        for at in np.ndindex(array.shape):
            kept, ends = array[at], []
            for step in (1e-6, -1e-6):
                array[at] = kept + step
                ends.append(loss(network, inputs, wanted))
            array[at] = kept
            slopes[at] = (ends[0] - ends[1]) / 2e-6
        numerical.append(slopes)
    for found, slopes in zip(_gradients(network, inputs, wanted), numerical, strict=True):
        np.testing.assert_allclose(found, slopes, rtol=1e-4, atol=1e-7)


def test_a_network_begins_near_a_mean_of_a_half_and_the_deviation_of_a_uniform_gene() -> None:
    inputs, _ = pairs(500, 0)
    mean, deviation = predict(_begin(3, (24,), 2, np.random.default_rng(0)), inputs)
    np.testing.assert_allclose(mean.mean(axis=0), 0.5, atol=0.2)
    np.testing.assert_allclose(np.log(deviation).mean(axis=0), np.log(12**-0.5), atol=0.2)


def test_a_known_map_is_learnt_with_how_far_off_it_may_be() -> None:
    network = train(*pairs(4000, 0), SMALL, 0)
    inputs, _ = pairs(1000, 1)
    mean, deviation = predict(network, inputs)
    near = (np.abs(inputs) < 2).all(axis=1)
    assert np.sqrt(np.mean((mean - means(inputs))[near] ** 2)) < 0.025
    assert np.abs(np.log(deviation / deviations(inputs)))[near].mean() < 0.15


def test_every_further_epoch_leaves_less_loss_on_fresh_pairs() -> None:
    fresh = pairs(1000, 1)
    lost = [loss(train(*pairs(2000, 0), SMALL, 0, epochs=iter(range(count))), *fresh) for count in (0, 2, 40)]
    assert lost[0] > lost[1] + 0.3 > lost[2] + 0.6
    assert lost[0] == pytest.approx(np.log(12**-0.5) + 0.5 * 0.03 * 12, abs=0.3)


def test_no_epochs_teach_nothing() -> None:
    given = pairs(100, 0)
    untaught = _begin(3, SMALL.hidden, 2, np.random.default_rng([0, 3]))
    for one, other in zip(train(*given, SMALL, 0, epochs=[]), untaught, strict=True):
        np.testing.assert_array_equal(one[0], other[0])


def test_the_same_seed_learns_the_same_bytes_and_another_does_not() -> None:
    one, again, other = (
        b"".join(array.tobytes() for layer in train(*pairs(300, 0), Training((8,), 3), seed) for array in layer)
        for seed in (0, 0, 1)
    )
    assert one == again != other


def test_few_pairs_are_one_batch() -> None:
    assert np.isfinite(loss(train(*pairs(5, 0), SMALL, 0), *pairs(5, 0)))
