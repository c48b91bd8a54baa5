import numpy as np

from scripts.mask_training.windows import FRAMED, LEAST, windows


def scenes(count: int) -> np.ndarray:
    classes = np.zeros((count, 100, 100), np.uint8)
    classes[:, 20:90, 40:70] = 2
    return classes


def test_windows_lie_in_their_scenes() -> None:
    middle, half = windows(scenes(500), 0.75, np.random.default_rng(0))
    assert (np.abs(middle) + half <= 1 + 1e-12).all()
    assert half.min() >= LEAST


def test_framed_windows_show_the_whole_tree() -> None:
    middle, half = windows(scenes(2000), 1.0, np.random.default_rng(1))
    low, high = middle - half, middle + half
    whole = (low <= [-0.2, -0.6]).all(axis=1) & (high >= [0.4, 0.8]).all(axis=1)
    assert FRAMED <= whole.mean() < 0.95


def test_a_scene_without_tree_has_windows_too() -> None:
    middle, half = windows(np.zeros((50, 64, 64), np.uint8), 1.0, np.random.default_rng(2))
    assert np.isfinite(middle).all()
    assert np.isfinite(half).all()
