"""The tree of a generator that behaves: a trunk, branches that rise from it, leaves along them."""

import numpy as np

TRUNK, ALONG, LEAVES = 12, 5, 10  # vertices of the trunk, vertices and leaves of a branch


def grow(values: dict, seed: int) -> dict[str, np.ndarray]:
    """Arrays of a plant with 12 + 5 vertices and 10 leaves a branch; every draw is keyed by seed and branch."""
    height, count = float(values["height"]), int(values["branches"])
    up = np.linspace(0, 1, TRUNK)
    trunk = np.stack([0.02 * height * np.sin(3 * up + seed % 7), 0 * up, height * up], axis=1)
    trunk[:, 0] -= trunk[0, 0]
    at = (2 + np.arange(count) * (TRUNK - 3) // count).astype(np.int32)  # vertex of the trunk
    turn = 2.4 * np.arange(count) + _draws(seed, 1, count)
    tilt = np.radians(float(values["angle"]) + 10 * _draws(seed, 2, count))
    length = height * float(values["reach"]) * (1.05 - up[at]) * (0.9 + 0.2 * _draws(seed, 3, count))
    axis = np.stack([np.cos(turn) * np.sin(tilt), np.sin(turn) * np.sin(tilt), np.cos(tilt)], axis=1)
    share = np.linspace(0, 1, ALONG)
    branches = trunk[at, None] + (length[:, None] * share)[..., None] * axis[:, None]
    first = TRUNK + ALONG * np.arange(count, dtype=np.int32)
    parent = np.repeat(first, ALONG).reshape(count, ALONG) + np.arange(-1, ALONG - 1, dtype=np.int32)
    parent[:, 0] = at
    thick = 0.004 * height * (1.1 - share) * np.ones((count, 1))
    return {
        "position": _single(trunk, branches),
        "parent": np.concatenate([np.arange(-1, TRUNK - 1), parent.ravel()]).astype(np.int32),
        "radius": np.concatenate([0.015 * height * (1.1 - up), thick.ravel()]).astype(np.float32),
        "level": np.repeat([0, 1], [TRUNK, ALONG * count]).astype(np.int32),
        **_leaves(branches, axis, turn, float(values["leaf_size"])),
    }


def _leaves(branches: np.ndarray, axis: np.ndarray, turn: np.ndarray, size: float) -> dict[str, np.ndarray]:
    count = len(branches)
    share = np.linspace(0.2, 1, LEAVES)[:, None]
    position = branches[:, :1] * (1 - share) + branches[:, -1:] * share
    side = np.stack([-np.sin(turn), np.cos(turn), 0 * turn], axis=1)[:, None] * np.resize([1.0, -1.0], LEAVES)[:, None]
    normal = np.cross(axis[:, None], side)
    return {
        "leaf_position": _single(position),
        "leaf_axis": _single(side),
        "leaf_normal": _single(normal),
        "leaf_size": np.full((count * LEAVES, 2), [size, size / 2], np.float32),
    }


def _single(*arrays: np.ndarray) -> np.ndarray:
    return np.concatenate([array.reshape(-1, 3) for array in arrays]).astype(np.float32)


def _draws(seed: int, purpose: int, count: int) -> np.ndarray:
    """Numbers (count,) in [0, 1), each keyed by `seed`, its `purpose` and its place."""
    return np.modf(np.abs(np.sin((seed % 9973) * 12.9898 + purpose * 78.233 + np.arange(count) * 37.719)) * 43758.5453)[
        0
    ]
