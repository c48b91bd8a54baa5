"""Entry of the program: `python run.py image=pine.png`; see `python run.py --help`."""

from __future__ import annotations

import sys

import hydra
from omegaconf import DictConfig

from experiments import entry


@hydra.main(version_base="1.3", config_path="conf", config_name="config")
def main(cfg: DictConfig) -> None:
    """Hand the configuration to experiments.<task>.run."""
    entry.run_task(cfg)


if __name__ == "__main__":
    sys.exit(entry.start(main))
