import dataclasses

import numpy as np
import pytest

from tests.asset.bodies import wood
from treefit.asset import AssetSettings
from treefit.asset.material.material import Material
from treefit.asset.mesh import Mesh
from treefit.asset.model import Model, Part, model_of
from treefit.asset.pictures.frame import Frame
from treefit.asset.pictures.picture import draw
from treefit.asset.pictures.scene import scene_of
from treefit.asset.pictures.thicken import pieces_of, thickened


def card(material: Material, normal=(0, -1, 0)) -> Model:
    """A square metre that faces the viewer, standing on the ground."""
    place = np.array([[-0.5, 0, 0], [0.5, 0, 0], [0.5, 0, 1], [-0.5, 0, 1]], np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    normals = np.tile(np.array(normal, np.float32), (4, 1))
    return Model("card", {"leaves": Part(Mesh(place, faces, normals, uv), material)})


FRAME = Frame(128, 128, 100.0)
ON_CARD = np.s_[20:108, 18:110]


def shown(material, normal=(0, -1, 0)):
    return draw(card(material, normal), FRAME).astype(int)[ON_CARD]


def test_the_base_texture_is_shown_upright_with_row_0_on_top():
    base = np.zeros((64, 64, 3), np.uint8)
    base[:32, :, 0] = base[32:, :, 2] = 200  # red over blue
    base[:, 32:, 1] = 200  # green on the right
    image = shown(Material("bark", (255, 255, 255), base))
    above, below = image[:40], image[-40:]
    assert (above[..., 0] > above[..., 2] + 50).all()
    assert (below[..., 2] > below[..., 0] + 50).all()
    assert (image[:, -40:, 1].mean() - image[:, :40, 1].mean()) > 80


def test_the_colour_multiplies_the_texture():
    white = np.full((8, 8, 3), 255, np.uint8)
    red = Material("bark", (200, 10, 10))
    np.testing.assert_allclose(shown(red), shown(dataclasses.replace(red, base=white)), atol=1)


def test_what_is_under_the_cutoff_shows_the_sky():
    base = np.full((64, 64, 4), 20, np.uint8)
    base[..., 3] = 255
    base[:, :32, 3] = 0
    image = shown(Material("leaves", (255, 255, 255), base, cutoff=0.5, two_sided=True))
    assert image[:20, :40].min() > 150
    assert image[:, -40:].max() < 120


def test_a_normal_map_turns_surfaces_to_the_light_green_being_up():
    flat = np.tile(np.array([128, 128, 255], np.uint8), (32, 32, 1))
    lit = {}
    for name, turned in {
        "up": (128, 220, 215),
        "down": (128, 36, 215),
        "left": (36, 128, 215),
        "right": (220, 128, 215),
    }.items():
        normal = np.full_like(flat, turned)
        lit[name] = shown(Material("bark", (128, 128, 128), normal=normal)).mean()
    assert lit["up"] > shown(Material("bark", (128, 128, 128), normal=flat)).mean() > lit["down"]
    assert lit["left"] > lit["right"]  # the sun stands on the left


def test_what_sees_less_of_the_sky_is_darker():
    model = card(Material("bark", (128, 128, 128)))
    mesh = model.parts["leaves"].mesh
    inside = dataclasses.replace(mesh, openness=np.full(4, 0.2, np.float32))
    dark = draw(Model("card", {"leaves": Part(inside, model.parts["leaves"].material)}), FRAME)
    assert dark[ON_CARD].mean() < draw(model, FRAME)[ON_CARD].mean() - 10


def test_thin_stems_are_unbroken_lines():
    twig = wood([[0, 0, 0], [0.3, 0.1, 0.5], [0.5, 0, 1]], [1e-4] * 3, [-1, 0, 1], [0, 0, 0])
    image = draw(model_of(twig, AssetSettings(bark="black", texture_size=0)), Frame(200, 200, 160.0))
    luminance = image.mean(axis=2)
    dark = luminance < np.median(luminance, axis=1, keepdims=True) - 12
    rows = np.flatnonzero(dark.any(axis=1))
    assert len(rows) > 150
    np.testing.assert_array_equal(rows, np.arange(rows[0], rows[-1] + 1))


@pytest.mark.parametrize("sides", [3, 7])
def test_tubes_are_thickened_to_a_radius_and_thick_ones_left_alone(sides):
    plant = wood([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [0.2, 0.05, 0.01], [-1, 0, 1], [0, 0, 0])
    mesh = model_of(plant, AssetSettings(sides=sides)).parts["trunk"].mesh
    thick = thickened(mesh, 0.05)
    low = mesh.vertices[:, 2] < 0.9
    np.testing.assert_array_equal(thick.vertices[low], mesh.vertices[low])
    ring = np.abs(mesh.vertices[:, 2] - 2) < 1e-6
    radius = np.hypot(*thick.vertices[ring, :2].T)
    assert radius[radius > 0.005] == pytest.approx(0.05, rel=0.08)
    assert thickened(mesh, 1e-6) is mesh


def test_leaves_are_pieces_of_their_own():
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10]], np.int32)
    assert pieces_of(faces).tolist() == [0, 0, 1, 1, 2]


def test_a_turned_scene_is_that_of_a_turned_plant():
    scene = scene_of(card(Material("bark", (1, 2, 3))), 0.0)
    turned = scene.turned(np.pi / 2)
    np.testing.assert_allclose(turned.place[1], [0, 0.5, 0], atol=1e-6)
    np.testing.assert_allclose(turned.normal[0], [1, 0, 0], atol=1e-6)
    assert turned.tall == scene.tall
