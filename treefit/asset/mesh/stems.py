"""Stems: the curves of a plant, each with a frame that does not twist; knows nothing of faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from treefit.plant import Plant
from treefit.plant.chains import JoinedChains, chains_of
from treefit.plant.curves import Curves, curves_of, plain_curves


@dataclass(frozen=True, eq=False)
class Stems(Curves):
    """Curves whose rings (r,) have a direction."""

    tangent: NDArray[np.float64]  # (r, 3) unit, along the stem
    side: NDArray[np.float64]  # (r, 3) unit, at right angles to the tangent
    along: NDArray[np.float64]  # (r,) m from where the stem begins
    narrowing: NDArray[np.float64]  # (r,) loss of radius per metre
    chains: JoinedChains  # what the curves go through
    stem: NDArray[np.int64]  # (r,) stem of each ring
    grown: bool  # along curves, out of each other and out of the ground


def stems_of(plant: Plant, plain: bool = False) -> Stems:
    """Return the stems of `plant` along smooth curves, or, `plain`, straight from vertex to vertex without collars."""
    chains = chains_of(plant)
    curves = plain_curves(chains) if plain else curves_of(chains)
    tangent, side, along = _frames(curves.first, curves.centre, curves.host, curves.share, curves.guided)
    return Stems(
        **vars(curves), tangent=tangent, side=side, along=along,
        narrowing=narrowing(curves.first, along, curves.radius), chains=chains,
        stem=np.repeat(np.arange(len(curves)), np.diff(curves.first)),
        grown=not plain and len(curves) > 0,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _frames(first, centre, host, share, guided):
    """Tangent (r, 3), side (r, 3) carried along without twist, and length along the stem (r,).

    A guided stem begins with the frame of its parent.
    """
    rings = centre.shape[0]
    tangent = np.zeros((rings, 3))
    side = np.zeros((rings, 3))
    along = np.zeros(rings)
    for stem in range(first.shape[0] - 1):
        low, high = first[stem], first[stem + 1]
        before = np.zeros(3)
        for i in range(low, high):
            after = np.zeros(3)
            if i + 1 < high:
                after = centre[i + 1] - centre[i]
                length = np.sqrt((after**2).sum())
                after /= length
                along[i + 1] = along[i] + length
            middle = before + after
            norm = np.sqrt((middle**2).sum())
            tangent[i] = middle / norm if norm > 1e-6 else (after if i + 1 < high else before)
            before = after
            previous = side[i - 1] if i > low else np.zeros(3)
            if i == low and guided[stem]:
                j = host[stem]
                tangent[i], previous = tangent[j], side[j]
                if share[stem] > 0:
                    middle = tangent[j] + share[stem] * (tangent[j + 1] - tangent[j])
                    tangent[i] = middle / np.sqrt((middle**2).sum())
            t = tangent[i]
            straight = previous - t * (previous * t).sum()
            norm = np.sqrt((straight**2).sum())
            if norm < 1e-6:
                axis = np.zeros(3)
                axis[np.argmin(np.abs(t))] = 1.0
                straight = axis - t * (axis * t).sum()
                norm = np.sqrt((straight**2).sum())
            side[i] = straight / norm
    return tangent, side, along


def narrowing(first: NDArray[np.int64], along: NDArray[np.float64], radius: NDArray[np.float64]) -> NDArray[np.float64]:
    """Loss of radius per metre (r,), over the segments before and after each ring."""
    index = np.arange(len(along))
    before, after = index - 1, index + 1
    before[first[:-1]] = first[:-1]
    after[first[1:] - 1] = first[1:] - 1
    loss: NDArray[np.float64] = (radius[before] - radius[after]) / (along[after] - along[before])
    return loss
