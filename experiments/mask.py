"""Task mask: how a picture is read, to be looked at before a long search."""

from __future__ import annotations

import json
import shlex
import sys
from pathlib import Path

import numpy as np
from omegaconf import DictConfig
from skimage.measure import approximate_polygon
from skimage.morphology import convex_hull_image

from experiments.read_tree import ReadTree, read_tree
from experiments.run_folder import run_folder
from treefit.mask import BACKGROUND, Mask

CORNERS = 8
"""Points at most of the outline that is shown as an example."""


def run(cfg: DictConfig) -> None:
    """Write mask.png and mask_overlay.png of cfg.image; print one JSON line about them last."""
    folder = run_folder()
    tree = read_tree(cfg, folder)
    found = tree.extraction
    print(f"mask={found.method}: {found.why}", file=sys.stderr)
    print(f"look at {folder / 'mask_overlay.png'}", file=sys.stderr)
    print("\n".join(what_next(tree, Path(cfg.image), folder)), file=sys.stderr)
    facts = {
        "method": found.method,
        "confidence": found.confidence,
        "warnings": tree.warnings,
        "tree_fraction": float((found.mask != BACKGROUND).mean()),
    }
    print(json.dumps(facts, ensure_ascii=False), flush=True)


def what_next(tree: ReadTree, image: Path, folder: Path) -> list[str]:
    """Two lines on what to do when the mask is wrong, each with a command to be copied."""
    height, width = tree.picture.shape
    corners = ",".join(f"[{x},{y}]" for x, y in rough_outline(tree.extraction.mask))
    here = f"image={shlex.quote(_as_typed(image))}"
    corrected = shlex.quote(_as_typed(folder / "mask.png"))
    return [
        f"wrong? say where it is, in pixels of {width} x {height} (or by mask.crop, mask.point, mask.hint): "
        f"python run.py task=mask {here} 'mask.outline=[{corners}]'",
        f"or paint over mask.png in its own three colours: python run.py {here} mask=file mask.path={corrected}",
    ]


def rough_outline(mask: Mask) -> list[tuple[int, int]]:
    """At most CORNERS points [x, y] in pixels around the tree of `mask`."""
    step = max(1, max(mask.shape) // 512)
    hull = np.pad(convex_hull_image(mask[::step, ::step] != BACKGROUND), 1)
    rows = [(row, np.flatnonzero(line)) for row, line in enumerate(hull) if line.any()]
    left = [(row, columns[0]) for row, columns in rows]
    right = [(row, columns[-1]) for row, columns in rows]
    ring = np.array([*left, *right[::-1], left[0]])
    corners, tolerance = ring, 1.0
    while len(corners) > CORNERS + 1:
        corners, tolerance = approximate_polygon(ring, tolerance), 1.3 * tolerance
    limits = (mask.shape[1], mask.shape[0])
    return [(min(int(x - 1) * step, limits[0]), min(int(y - 1) * step, limits[1])) for y, x in corners[:-1]]


def _as_typed(path: Path) -> str:
    """`path` as it is typed from where the user stands."""
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else str(path)
