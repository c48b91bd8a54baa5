"""Levels: a plant at several counts of triangles, all made from one skeleton, down to crossed cards."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from treefit.asset.lod.cones import cones
from treefit.asset.lod.impostor import impostor
from treefit.asset.lod.leaf_cards import LeafForms, joined, leaf_forms
from treefit.asset.lod.leaf_choice import Sights, choose_leaves, sights_of, spread_order
from treefit.asset.lod.silhouette import Silhouettes, covered, silhouette_iou, silhouettes
from treefit.asset.lod.stem_tree import StemTree, stem_tree
from treefit.asset.lod.thin_wood import ThinWood, thin_wood
from treefit.asset.material.tree_materials import TreeColours
from treefit.asset.mesh import Mesh, crown_of, stems_of
from treefit.asset.mesh.leaf_outline import outline_of
from treefit.asset.mesh.openness import Crown
from treefit.asset.mesh.skin import Skin, skin_of
from treefit.asset.mesh.stems import Stems
from treefit.asset.model import Model, Part, model_of
from treefit.asset.settings import AssetSettings, Detail
from treefit.plant import Plant

_DENSE = 0.8  # share of the outline that is filled from which three cards do not look denser than the plant
_FOR_LEAVES = (0.85, 0.7, 0.5)  # shares of the triangles that are tried, as long as silhouettes gain by it


@dataclass(frozen=True, eq=False)
class Level:
    """One level of detail."""

    model: Model  # tree_LOD0, tree_LOD1, ...
    wanted: Detail  # the entry of the settings
    triangles: int
    vertices: int
    silhouette_iou: float  # with the whole model, mean over four sides


def levels_of(plant: Plant, settings: AssetSettings, seen: TreeColours | None = None) -> list[Level]:
    """Return `plant` at every entry of settings.lods; `seen` are colours of a picture.

    Shares are of the triangles of the whole model, which 1.0 is. A level has at most what it is asked, or the trunk
    alone as the least that is possible.
    """
    whole = model_of(plant, settings, seen)
    thinner = _Thinner(plant, settings, whole)
    levels = []
    for number, wanted in enumerate(settings.lods or (1.0,)):
        model, iou = thinner.model(wanted)
        model = replace(model, name=f"tree_LOD{number}")
        levels.append(Level(model, wanted, model.counts.triangles, model.counts.vertices, iou))
    return levels


@dataclass(frozen=True, eq=False)
class _Thinner:
    """What all levels of a plant are made from."""

    plant: Plant
    settings: AssetSettings
    whole: Model

    @cached_property
    def outlines(self) -> Silhouettes:
        return silhouettes(self.whole)

    @cached_property
    def stems(self) -> Stems:
        return stems_of(self.plant)

    @cached_property
    def skin(self) -> Skin:
        return skin_of(self.stems)

    @cached_property
    def tree(self) -> StemTree:
        return stem_tree(self.stems, self.settings.sides)

    @cached_property
    def crown(self) -> Crown:
        return crown_of(self.plant)

    @cached_property
    def sights(self) -> Sights:
        return sights_of(self.plant, self.outlines.extent)

    @cached_property
    def exposed(self) -> NDArray[np.float32]:
        return self.sights.exposed()

    @cached_property
    def forms(self) -> LeafForms:
        outline = outline_of(self.settings.leaf_outline, self.plant)
        return leaf_forms(self.plant, self.whole.parts["leaves"], outline, self.settings.leaf_fold)

    @cached_property
    def wood_seen(self) -> NDArray[np.float64]:
        centre = self.stems.centre.astype(np.float32)
        return self.sights.seen(centre).astype(np.float64) if self.plant.n_leaves else np.ones(len(centre))

    @cached_property
    def order(self) -> NDArray[np.int64]:
        return spread_order(self.plant.leaf_position)

    def model(self, wanted: Detail) -> tuple[Model, float]:
        """The model at `wanted`, and how far its silhouette agrees with that of the whole one."""
        if wanted == "billboard":
            sides = 3 if self.outlines.fill >= _DENSE else 2
            return self.judged(impostor(self.whole, sides, self.settings.texture_size))
        triangles = self.whole.counts.triangles
        budget = int(wanted * triangles) if isinstance(wanted, float) else wanted
        if budget >= triangles:
            return self.whole, 1.0
        if not self.plant.n_leaves or not len(self.stems):
            return self.judged(self.thinned(budget, 1.0 if self.plant.n_leaves else 0.0))
        best = self.judged(self.thinned(budget, _FOR_LEAVES[0]))
        for share in _FOR_LEAVES[1:]:
            found = self.judged(self.thinned(budget, share))
            if found[1] <= best[1]:
                break
            best = found
        return best

    def judged(self, model: Model) -> tuple[Model, float]:
        return model, silhouette_iou(self.outlines, silhouettes(model, self.outlines.extent))

    def thinned(self, budget: int, for_leaves: float) -> Model:
        """The plant in `budget` triangles, of which leaves have the share `for_leaves` or what they can use."""
        parts: dict[str, Part] = {}
        left = budget
        if len(self.stems):
            all_leaves = self.plant.n_leaves * self.forms.faces_each if self.plant.n_leaves else 0
            thin = thin_wood(self.tree, self.wood_seen, budget - min(all_leaves, int(for_leaves * budget)))
            parts, left = self.wood(thin), budget - thin.triangles
        if self.plant.n_leaves and left > 0:
            parts["leaves"] = Part(self.leaves(left, parts), self.whole.parts["leaves"].material)
        return Model(self.whole.name, parts)

    def wood(self, thin: ThinWood) -> dict[str, Part]:
        parts = {}
        for name, chosen in (("trunk", thin.level == 0), ("branches", thin.level > 0)):
            if chosen.any():
                mesh = self.crown.shaded(cones(thin.only(chosen), self.stems, self.skin))
                parts[name] = Part(mesh, self.whole.parts[name].material)
        return parts

    def leaves(self, budget: int, wood: dict[str, Part]) -> Mesh:
        """Leaves of `budget` triangles: as many as can be of one each, those that show most then of two, then whole."""
        forms, count = self.forms, min(self.plant.n_leaves, budget)
        if count < self.plant.n_leaves:
            index, size = choose_leaves(self.sights, self.covered(wood), self.order, count)
        else:
            index, size = np.arange(count), np.ones(count, dtype=np.float32)
        rank = np.empty(count, dtype=np.int64)
        rank[np.argsort(-self.exposed[index], kind="stable")] = np.arange(count)
        cards = min(budget - count, count)
        wholes = min((budget - count - cards) // max(forms.faces_each - 2, 1), count)
        kinds = ((rank < wholes), (rank >= wholes) & (rank < cards), rank >= cards)
        meshes = [
            forms.wholes(index[chosen]) if form is None else forms.simple(form, index[chosen], size[chosen])
            for form, chosen in zip((None, forms.card, forms.slip), kinds, strict=True) if chosen.any()
        ]  # fmt: skip
        return joined(meshes)

    def covered(self, wood: dict[str, Part]) -> NDArray[np.bool_]:
        """What `wood` covers (views, rows, columns) in all sights."""
        mask = np.zeros(self.sights.depth.shape, dtype=bool)
        for i, view in enumerate(self.sights.views):
            mask[i, : view.rows, : view.columns] = covered(wood.values(), view)
        return mask
