"""three.js with its GLTF loader: what draws the trees in a browser, taken out of the page that trimesh ships."""

from __future__ import annotations

import io
import zipfile
from functools import cache
from importlib import resources

_BEGINS, _ENDS = "/**\n * @license", "THREE.GLTFLoader=GLTFLoader;})();"  # trimesh's own start code follows


@cache
def three_js() -> str:
    """Return the script (MIT licence, kept in its first lines)."""
    packed = resources.files("trimesh").joinpath("resources", "templates", "viewer.zip").read_bytes()
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        page = archive.read("viewer.html.template").decode("utf-8")
    begin, end = page.find(_BEGINS), page.find(_ENDS)
    if begin < 0 or end < 0:
        raise RuntimeError("trimesh's viewer template holds no three.js with a GLTF loader")
    return page[begin : end + len(_ENDS)]
