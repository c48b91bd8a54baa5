"""Trees: which model, colours and habit the tree of a scene and its neighbours get."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scripts.mask_training.scenery.arrays import Rng, chance
from scripts.mask_training.scenery.clumps import clumped
from scripts.mask_training.scenery.conifers import whorled
from scripts.mask_training.scenery.grown import grown, grown_bare
from scripts.mask_training.scenery.model import Model, bare
from scripts.mask_training.scenery.palettes import drawn_bark, drawn_palette, drawn_season
from scripts.mask_training.scenery.render import Look

KINDS = {"clumps": 0.45, "grown": 0.33, "whorls": 0.12, "bare": 0.10}


@dataclass(frozen=True, eq=False)
class Tree:
    """A model with its colours; `season` is that of the scene around it."""

    model: Model
    look: Look
    season: str
    kind: str


def drawn_kind(rng: Rng) -> str:
    """Kind of tree by the shares of KINDS."""
    return str(rng.choice(list(KINDS), p=list(KINDS.values())))


def drawn_tree(kind: str, rng: Rng, leaves: int) -> Tree:
    """A tree of `kind` with at most about `leaves` leaves."""
    if kind == "bare":
        model = bare(grown_bare(rng))
        season = "snow" if chance(rng, 0.45) else "bare"
        snow = rng.uniform(0.3, 1.0) if season == "snow" and chance(rng, 0.4) else 0.0
        return Tree(model, _look(model, "autumn", snow, rng), season, kind)
    model = {"clumps": clumped, "whorls": whorled, "grown": grown}[kind](rng, leaves)
    season = drawn_season(rng)
    if model.conifer:
        season = str(rng.choice(["green", "autumn", "snow"], p=(0.7, 0.1, 0.2)))
    snow = rng.uniform(0.1, 0.8) if season == "snow" and chance(rng, 0.4) else 0.0
    return Tree(model, _look(model, season, snow, rng), season, kind)


def neighbour(tree: Tree, rng: Rng, leaves: int) -> Tree:
    """A tree to stand beside `tree`: the same, of the same kind in other colours, or another one."""
    if tree.model.n_leaves and chance(rng, 0.45):
        rows = rng.random(tree.model.n_leaves) < leaves / tree.model.n_leaves
        thin = replace(
            tree.model, leaf_place=tree.model.leaf_place[rows], leaf_axis=tree.model.leaf_axis[rows],
            leaf_normal=tree.model.leaf_normal[rows], leaf_size=tree.model.leaf_size[rows] * 1.25,
        )  # fmt: skip
        look = tree.look if chance(rng, 0.6) else _look(thin, _colours_of(tree.season), tree.look.snow, rng)
        return replace(tree, model=thin, look=look)
    kind = "bare" if tree.season in ("snow", "bare") and chance(rng, 0.5) else drawn_kind(rng)
    other = drawn_tree(kind, rng, leaves)
    if other.season == tree.season or kind == "bare":
        return other
    return replace(other, look=_look(other.model, _colours_of(tree.season), tree.look.snow, rng))


def _colours_of(season: str) -> str:
    return season if season in ("green", "spring", "autumn") else "green"


def _look(model: Model, season: str, snow: float, rng: Rng) -> Look:
    palette = drawn_palette(_season_of_leaves(season), model.conifer, rng)
    square = 2.0 if chance(rng, 0.6) else 1.0
    return Look(palette, rng.uniform(0.05, 0.3), drawn_bark(rng), float(snow), square)


def _season_of_leaves(season: str) -> str:
    return "green" if season in ("snow", "bare") else season


def slender(model: Model) -> float:
    """Width of the tree over its height."""
    points = model.leaf_place if model.n_leaves else model.stem_to
    low, high = np.quantile(points[:, 0], (0.02, 0.98))
    return float(high - low)
