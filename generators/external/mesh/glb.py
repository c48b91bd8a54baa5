"""GLB: the mesh of a tree in a binary glTF file is read, once its header shows that it is not too large."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path

from generators.external.faults import TooLarge
from generators.external.mesh.rules import Mesh
from generators.external.mesh.scene import plant_of_scene
from treefit.plant import Plant

_CORNERS = 12  # entries of an accessor a vertex, at most: two triangles a vertex are usual, and their backs
_FOREIGN = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing")


def read_mesh(path: Path, rules: Mesh, max_vertices: int) -> Plant:
    """Plant of the mesh in the GLB file `path` (y up), read by `rules`.

    TooLarge when it has more than `max_vertices`, ValueError in one line when it is no GLB file or there is no tree.
    """
    data = path.read_bytes()
    _check(data, max_vertices)
    import trimesh  # heavy: only those who read meshes need it

    try:
        scene = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)  # no path: it opens no other file
    except Exception as error:
        raise ValueError(
            f"mesh: cannot be read as GLB: {' '.join(str(error).split()) or type(error).__name__}"
        ) from None
    return plant_of_scene(scene, rules, "y")


def _check(data: bytes, most: int) -> None:
    """Raise when the header tells of more vertices than `most`, or of what is not read."""
    if data[:4] != b"glTF" or len(data) < 20:
        raise ValueError("mesh: is no GLB file")
    try:
        header = json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])
        used = set(header.get("extensionsRequired", [])) | set(header.get("extensionsUsed", []))
        counts = [int(accessor["count"]) for accessor in header.get("accessors", [])]
        meshes = [
            sum(counts[primitive["attributes"]["POSITION"]] for primitive in mesh["primitives"])
            for mesh in header.get("meshes", [])
        ]
        vertices = sum(meshes[node["mesh"]] for node in header.get("nodes", []) if "mesh" in node)
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"mesh: is no sound GLB file: {type(error).__name__} {error}") from None
    foreign = [name for name in _FOREIGN if name in used]
    if foreign:
        raise ValueError(f"mesh: has {', '.join(foreign)}, which is not read; write it without")
    if vertices > most or sum(meshes) > most:
        raise TooLarge(f"the mesh has {max(vertices, sum(meshes)):,} vertices, over generator.max_vertices={most}")
    if max(counts, default=0) > _CORNERS * most:
        raise TooLarge(f"the mesh has {max(counts):,} corners, over {_CORNERS} times generator.max_vertices={most}")
