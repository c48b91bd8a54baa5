"""Pictures drawn by OpenGL through pyrender, before the same sky and ground as those of `draw`.

pyrender knows no alpha cutoff, so leaves are cut out by coverage; no light comes through them, and their shadows are
those of whole cards.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from treefit.asset.material.colour import to_linear
from treefit.asset.material.material import Material
from treefit.asset.mesh import Mesh
from treefit.asset.model import Model
from treefit.asset.pictures.backdrop import backdrop
from treefit.asset.pictures.frame import Frame
from treefit.asset.pictures.light import SUN, sun_map
from treefit.asset.pictures.scene import scene_of
from treefit.asset.pictures.thicken import thickened
from treefit.opengl import front_pose, gl_missing, gl_renderer

Picture = NDArray[np.uint8]  # (h, w, 3) sRGB
Floats = NDArray[np.float32]

_SUN, _SUN_COLOUR, _SKY = 8.5, (1.0, 0.92, 0.76), (0.50, 0.54, 0.56)  # as bright as the software's
_FINER = 2  # samples a pixel along each side, four coverages each


def gl_draw(model: Model, frame: Frame, thinnest: float) -> Picture:
    """Return a picture (frame.height, frame.width, 3); stems are drawn with a radius of `thinnest` (m) or more.

    ValueError with one line that says what is missing when there is no OpenGL.
    """
    require_gl()
    scene = scene_of(model, thinnest)
    image = backdrop(frame, sun_map(scene, frame.height), scene)
    drawn = _rendered(model, frame, thinnest)
    return np.asarray((image * (1 - drawn[..., 3:]) + drawn[..., :3]).clip(0, 1) * 255 + 0.5, dtype=np.uint8)


def require_gl() -> None:
    """Raise ValueError with one line that says what is missing when there is no OpenGL."""
    missing = gl_missing()
    if missing is not None:
        raise ValueError(f"asset.renderer=pyrender: {missing}, asset.renderer=software")


def _rendered(model: Model, frame: Frame, thinnest: float) -> Floats:
    """Red, green, blue times coverage, and coverage (h, w, 4) in [0, 1]."""
    import pyrender
    from OpenGL import GL

    renderer = gl_renderer()
    scene = pyrender.Scene(bg_color=(0, 0, 0, 0), ambient_light=_SKY)
    for part in model.parts.values():
        mesh = part.mesh if part.material.two_sided else thickened(part.mesh, thinnest)
        scene.add(pyrender.Mesh([_primitive(mesh, _material(part.material))]))
    low, high = (float(y) for y in scene.bounds[:, 1])
    tall = frame.height / frame.scale
    camera = pyrender.OrthographicCamera(
        xmag=frame.width / (2 * frame.scale), ymag=tall / 2, znear=0.05 * tall, zfar=high - low + tall
    )
    scene.add(camera, pose=front_pose(low - 0.5 * tall, frame.base / frame.scale - tall / 2))
    scene.add(pyrender.DirectionalLight(color=_SUN_COLOUR, intensity=_SUN), pose=_sun_pose())
    renderer.viewport_width, renderer.viewport_height = frame.width * _FINER, frame.height * _FINER
    cut_out = (GL.GL_SAMPLE_ALPHA_TO_COVERAGE, GL.GL_SAMPLE_ALPHA_TO_ONE)
    flags = pyrender.RenderFlags
    try:
        for switch in cut_out:
            GL.glEnable(switch)
        drawn, _ = renderer.render(scene, flags=int(flags.RGBA | flags.SHADOWS_DIRECTIONAL), seg_node_map=None)
    finally:  # masks are drawn by the same renderer
        for switch in cut_out:
            GL.glDisable(switch)
    parts = drawn.reshape(frame.height, _FINER, frame.width, _FINER, 4)
    mean = np.asarray(parts.mean(axis=(1, 3)) / 255, dtype=np.float32)
    mean[round(frame.base) :] = 0  # a foot reaches into the ground
    return mean


def _primitive(mesh: Mesh, material: Any) -> Any:
    import pyrender

    sky = np.ones(len(mesh.vertices)) if mesh.openness is None else mesh.openness
    colour = np.column_stack([sky, sky, sky, np.ones(len(sky))]).astype(np.float32)
    return pyrender.Primitive(
        positions=mesh.vertices, normals=mesh.normals, texcoord_0=mesh.uv, color_0=colour, indices=mesh.faces,
        material=material, mode=4,
    )  # fmt: skip


def _material(material: Material) -> Any:
    import pyrender

    return pyrender.MetallicRoughnessMaterial(
        baseColorFactor=(*to_linear(material.colour), 1.0),
        baseColorTexture=material.base,
        normalTexture=material.normal,
        metallicFactor=0.0,
        roughnessFactor=material.rough,
        doubleSided=material.two_sided,
    )


def _sun_pose() -> NDArray[np.float64]:
    """Pose (4, 4) of a light that shines along its own -z."""
    pose = np.eye(4)
    pose[:3, 0] = np.cross([0.0, 0.0, 1.0], SUN)
    pose[:3, 0] /= np.linalg.norm(pose[:3, 0])
    pose[:3, 1], pose[:3, 2] = np.cross(SUN, pose[:3, 0]), SUN
    return pose
