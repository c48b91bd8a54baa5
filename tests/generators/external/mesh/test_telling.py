from __future__ import annotations

import numpy as np
import pytest
import trimesh

from generators.external.mesh import Mesh, plant_of_scene
from tests.generators.external.mesh.shapes import card, joined, pole, scene
from treefit.plant.characteristics import MEASURES

pytestmark = pytest.mark.slow  # kernels of meshes take half a minute to compile

CARD = [0.1, 0, 1.4], [0.5, 0, 0], [0, 0.2, 0]


def leaves(made: trimesh.Scene | trimesh.Trimesh, **rules: str) -> int:
    return plant_of_scene(made, Mesh(**rules), "z").n_leaves


@pytest.mark.parametrize(
    ("names", "kind"),
    [
        (("Leaves_Oak", "object"), "leaf"), (("", "crown_TWIGS"), "leaf"), (("bark", "leaves"), "wood"),
        (("tree_leaves", ""), "leaf"), (("leaf_stem", ""), "leaf"), (("Material.001", "Branches"), "wood"),
        (("Material.001", "tree"), None),
    ],
)  # fmt: skip
def test_names_of_materials_tell_before_names_of_objects(names: tuple[str, str], kind: str | None) -> None:
    assert Mesh().kind(names, see_through=False) == kind


def test_the_users_words_come_before_the_usual_ones() -> None:
    assert Mesh(wood="leaf_?rachis").kind(("Leaf_Rachis",), True) == "wood"
    assert Mesh(leaf="^mat2$", wood="mat").kind(("MAT2", "branch"), False) == "leaf"
    assert Mesh(leaf="^mat2$", wood="mat").kind(("mat3", "leaf"), True) == "wood"


def test_alpha_tells_where_names_do_not() -> None:
    made = scene(materials=False, thing=pole(), other=(trimesh.creation.icosphere(1, 0.3), "MASK"))
    assert leaves(made) == 80
    assert Mesh().kind(("", "x"), see_through=True) == "leaf"


def test_plane_pieces_are_leaves_where_nothing_else_tells() -> None:
    assert leaves(joined([pole(), card(*CARD), card([-0.1, 0, 1.2], [-0.4, 0, 0.2], [0, 0.1, 0])])) == 2


def test_one_tube_of_three_sides_is_wood() -> None:
    assert leaves(trimesh.creation.cylinder(0.1, 2.0, sections=3)) == 0


def test_places_of_a_scene_are_kept() -> None:
    made = trimesh.Scene()
    made.add_geometry(pole(), geom_name="bark")
    for i in range(5):
        made.add_geometry(
            card(*CARD), geom_name=f"leaf{i}", transform=trimesh.transformations.translation_matrix([0, 0, 0.1 * i])
        )
    plant = plant_of_scene(made, Mesh(), "z")
    np.testing.assert_allclose(np.sort(plant.leaf_position[:, 2]), 1.4 + 0.1 * np.arange(5), atol=1e-5)


def test_complexity_is_that_of_mesh_vertices_unless_they_are_counted_by_node() -> None:
    made = scene(bark=pole(), leaves=card(*CARD))
    assert MEASURES["vertices"](plant_of_scene(made, Mesh(), "z")) == len(pole().vertices) == 28
    assert MEASURES["vertices"](plant_of_scene(made, Mesh(vertices_per_node=7), "z")) == 4


@pytest.mark.parametrize(
    ("rules", "words"),
    [({"leaf": "("}, "leaf must be a regular expression"), ({"vertices_per_node": 0}, "number over 0"),
     ({"vertices_per_node": True}, "number over 0"), ({"wood": 3}, "wood must be a regular expression")],
)  # fmt: skip
def test_bad_rules_are_refused(rules: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=f"mesh: .*{words}"):
        Mesh(**rules)  # type: ignore[arg-type]


def _moved(value: float) -> trimesh.Trimesh:
    mesh = pole()
    corners = mesh.vertices.copy()
    corners[3, 1] = value
    return trimesh.Trimesh(corners, mesh.faces, process=False)


@pytest.mark.parametrize(
    ("mesh", "words"),
    [
        (scene(leaves=card(*CARD)), "no wood, only foliage"), (card(*CARD), "no wood"),
        (trimesh.Scene(), "no triangles"),
        (_moved(np.nan), "NaN or infinite"), (_moved(np.inf), "NaN or infinite"), (_moved(1e7), "reaches"),
        (trimesh.Trimesh(np.zeros((3, 3)), [[0, 1, 2]], process=False), "at one place"),
        (scene(bark=card(*CARD)), "no length|no height"),
    ],
)  # fmt: skip
def test_what_is_no_tree_is_refused_in_one_line(mesh: trimesh.Scene | trimesh.Trimesh, words: str) -> None:
    with pytest.raises(ValueError, match=f"^mesh: .*({words})[^\n]*$"):
        plant_of_scene(mesh, Mesh(), "z")
