"""Train the network of mask=network on painted scenes, and write it as ONNX; killed, the same command goes on.

Usage: python -m scripts.train_mask_network [--folder runs/mask_network] [--minutes 150] [--steps 6000 ...]
Needs: python -m pip install -e ".[train]"
"""

from __future__ import annotations

import argparse
from dataclasses import fields
from pathlib import Path

from scripts.mask_training.plan import Plan

ROOT = Path(__file__).parents[1]


def main() -> None:
    """Train and export; task=masks measures what came of it."""
    arguments = _arguments()
    # spawned painters import this file: they must not wait for torch
    import torch

    from scripts.mask_training.export import export
    from scripts.mask_training.scene import scene
    from scripts.mask_training.train import train

    torch.set_num_threads(arguments.threads)
    torch.use_deterministic_algorithms(True)
    plan = Plan(**{field.name: getattr(arguments, field.name) for field in fields(Plan)})
    learner = train(plan, scene, arguments.folder, 60 * arguments.minutes, arguments.workers)
    path = arguments.export or arguments.folder / "tree.onnx"
    size = export(learner.average, plan, learner.step, path)
    print(f"{path}: {size / 1e6:.2f} MB after {learner.step} steps")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=Path, default=ROOT / "runs" / "mask_network", help="checkpoint, log, pictures")
    parser.add_argument("--export", type=Path, help="ONNX file; <folder>/tree.onnx")
    parser.add_argument("--minutes", type=float, default=150, help="it stops then, finished or not")
    parser.add_argument("--workers", type=int, default=1, help="processes that paint")
    parser.add_argument("--threads", type=int, default=1, help="threads that learn; others change the last digits")
    for field in fields(Plan):
        option = f"--{field.name.replace('_', '-')}"
        if isinstance(field.default, bool):
            parser.add_argument(option, action=argparse.BooleanOptionalAction, default=field.default)
        else:
            parser.add_argument(option, type=type(field.default), default=field.default)
    return parser.parse_args()


if __name__ == "__main__":
    main()
