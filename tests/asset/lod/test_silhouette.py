"""What stands out against the sky, and how far two models agree in it."""

import numpy as np
import pytest

from treefit.asset.lod.silhouette import silhouette_iou, silhouettes
from treefit.asset.material.material import Material
from treefit.asset.mesh import Mesh
from treefit.asset.model import Model, Part

BARK = Material("bark", (100, 80, 60))


def _wall(left: float, right: float, high: float = 1.0) -> Mesh:
    """A wall in the x-z plane."""
    place = np.array([[left, 0, 0], [right, 0, 0], [right, 0, high], [left, 0, high]], np.float32)
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    return Mesh(place, np.array([[0, 1, 2], [0, 2, 3]], np.int32), np.tile(np.float32([0, -1, 0]), (4, 1)), uv)


def _model(mesh: Mesh, material: Material = BARK) -> Model:
    return Model("tree_LOD0", {"trunk": Part(mesh, material)})


def test_a_model_agrees_with_itself():
    whole = silhouettes(_model(_wall(-1, 1)))
    assert silhouette_iou(whole, whole) == 1


def test_agreement_is_intersection_over_union_from_the_sides_that_see_it():
    whole = silhouettes(_model(_wall(-1, 1)), azimuths=(0.0,))
    half = silhouettes(_model(_wall(0, 1)), whole.extent, azimuths=(0.0,))
    assert silhouette_iou(whole, half) == pytest.approx(0.5, abs=0.01)


def test_things_finer_than_a_pixel_count_by_their_share_of_it():
    whole = silhouettes(_model(_wall(-1, 1)), azimuths=(0.0,))
    wire = silhouettes(_model(_wall(0, 1 / 512)), whole.extent, azimuths=(0.0,))
    assert 0 < wire.coverage[0].sum() / whole.coverage[0].sum() < 2 / 1024


def test_where_alpha_is_under_the_cutoff_there_is_nothing():
    base = np.full((64, 64, 4), 255, np.uint8)
    base[:32, :, 3] = 0  # the upper half
    holes = Material("leaves", (90, 140, 60), base, cutoff=0.5, two_sided=True)
    whole = silhouettes(_model(_wall(-1, 1)), azimuths=(0.0,))
    lower = silhouettes(_model(_wall(-1, 1), holes), whole.extent, azimuths=(0.0,))
    assert silhouette_iou(whole, lower) == pytest.approx(0.5, abs=0.01)
    rows = lower.coverage[0].sum(axis=1)
    assert rows[:120].sum() == 0
