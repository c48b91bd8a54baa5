from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from generators.external.faults import TooLarge
from generators.external.mesh import Mesh, read_mesh
from generators.gegen import gegen
from generators.simplegen import SimpleGen
from tests.generators.external.mesh.shapes import pole, scene
from treefit.asset import AssetSettings, write_glb
from treefit.plant import Budget, Generator, Plant
from treefit.view import Frame, OrthographicView

pytestmark = pytest.mark.slow  # kernels of meshes take half a minute to compile

MOST = 200_000
PLAIN = AssetSettings(texture_size=0, leaf_fold=0, leaf_outline="broad")


def overlap(a: np.ndarray, b: np.ndarray) -> float:
    return float((a & b).sum() / (a | b).sum())


@pytest.mark.parametrize(("generator", "genome"), [(SimpleGen(), 3), (gegen(), 2)])
def test_a_tree_that_was_written_is_read_again(generator: Generator, genome: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    genes = [rng.random(len(generator.space)) for _ in range(genome + 1)][-1]
    plant = generator(generator.space.decode(genes), genome, Budget())
    write_glb(plant, tmp_path / "tree.glb", PLAIN)
    read = read_mesh(tmp_path / "tree.glb", Mesh(), MOST)
    assert read.n_leaves == plant.n_leaves
    assert read.level.max() <= plant.level.max() + 2
    view, frame = OrthographicView(), Frame(128, 8)
    a, b = view(plant, frame).unpack(), view(read, frame).unpack()
    assert overlap(a > 0, b > 0) > 0.85
    for kind in (1, 2):
        assert (b == kind).sum() == pytest.approx((a == kind).sum(), rel=0.25)


def test_the_same_file_gives_the_same_bytes(tmp_path: Path) -> None:
    write_glb(_bush(), tmp_path / "tree.glb", PLAIN)
    a, b = (read_mesh(tmp_path / "tree.glb", Mesh(), MOST) for _ in range(2))
    for name in ("position", "radius", "parent", "level", "leaf_position", "leaf_axis", "leaf_normal", "leaf_size"):
        assert getattr(a, name).tobytes() == getattr(b, name).tobytes(), name


def test_too_many_vertices_are_told_by_the_header_alone(tmp_path: Path) -> None:
    (tmp_path / "tree.glb").write_bytes(_glb(100_000_000))
    with pytest.raises(TooLarge, match=r"100,000,000 vertices, over generator.max_vertices=200000"):
        read_mesh(tmp_path / "tree.glb", Mesh(), MOST)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no GLB"), (b"PK\x03\x04" + bytes(100), "no GLB"), (b"glTF" + bytes(30), "no sound GLB"),
        ("cut", "mesh: "), ("draco", "KHR_draco_mesh_compression"),
    ],
)  # fmt: skip
def test_what_is_no_sound_file_is_refused_in_one_line(content: bytes | str, words: str, tmp_path: Path) -> None:
    whole = scene(bark=pole()).export(file_type="glb")
    parts = {"cut": whole[: len(whole) // 2], "draco": _glb(3, extensionsUsed=["KHR_draco_mesh_compression"])}
    (tmp_path / "tree.glb").write_bytes(parts[content] if isinstance(content, str) else content)
    with pytest.raises(ValueError, match=r"^mesh: [^\n]*$") as caught:
        read_mesh(tmp_path / "tree.glb", Mesh(), MOST)
    assert words in str(caught.value)


def _bush() -> Plant:
    generator = SimpleGen()
    return generator(generator.space.complete({}), 3, Budget(800, 500))


def _glb(vertices: int, **more: object) -> bytes:
    """A file that says it has so many vertices, and has none."""
    content = {
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"count": vertices, "componentType": 5126, "type": "VEC3"}], **more,
    }  # fmt: skip
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text
