"""Task mask: how a picture is read, to be looked at before a long search."""

from __future__ import annotations

import json
import sys

from omegaconf import DictConfig

from experiments.read_tree import read_tree
from experiments.run_folder import run_folder
from treefit.mask import BACKGROUND


def run(cfg: DictConfig) -> None:
    """Write mask.png and mask_overlay.png of cfg.image; print one JSON line about them last."""
    folder = run_folder()
    tree = read_tree(cfg, folder)
    found = tree.extraction
    print(f"mask={found.method}: {found.why}", file=sys.stderr)
    print(f"look at {folder / 'mask_overlay.png'}", file=sys.stderr)
    facts = {
        "method": found.method,
        "confidence": found.confidence,
        "warnings": tree.warnings,
        "tree_fraction": float((found.mask != BACKGROUND).mean()),
    }
    print(json.dumps(facts, ensure_ascii=False), flush=True)
