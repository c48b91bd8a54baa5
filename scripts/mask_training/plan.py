"""Plan: the settings of one training, all that decides its bytes."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Plan:
    """A round is `scenes` painted pictures, learned `views` times, each time cropped, stretched and coloured anew.

    The next round is painted while one is learned, so `views` balances the painter and the learner.
    """

    seed: int = 0
    steps: int = 6000
    batch: int = 16
    size: int = 256  # pixels of the longer side of what the network sees
    canvas: int = 288  # pixels of a painted scene: larger, so that crops stay sharp
    width: int = 24  # channels of the first level
    scenes: int = 1024
    views: int = 3
    rate: float = 2e-3
    warmup: int = 200  # steps until the rate is reached
    decay: float = 0.01  # of AdamW
    memory: float = 0.998  # of the moving average of the weights, a step
    branch_weight: float = 2.0  # of the cross-entropy: branches are a few percent of the pixels
    bfloat16: bool = True  # arithmetic of the convolutions: 1.7 times faster on a CPU that has it, else slower
    held_out: int = 128  # scenes of another seed that it is judged by

    def __post_init__(self) -> None:
        if self.scenes * self.views % self.batch:
            raise ValueError(f"scenes x views must be a multiple of batch, got {self.scenes} x {self.views}")
        if self.size % 64:
            raise ValueError(f"size must be a multiple of 64, got {self.size}")

    @property
    def steps_a_round(self) -> int:
        """Steps from one checkpoint to the next."""
        return self.scenes * self.views // self.batch

    @property
    def rounds(self) -> int:
        """Rounds until all steps are done; the last may be shorter."""
        return math.ceil(self.steps / self.steps_a_round)

    def rate_at(self, step: int) -> float:
        """Learning rate: rises evenly for `warmup` steps, then falls as a half cosine to a hundredth."""
        if step < self.warmup:
            return self.rate * (step + 1) / self.warmup
        share = (step - self.warmup) / max(1, self.steps - self.warmup)
        return self.rate * (0.01 + 0.99 * 0.5 * (1 + math.cos(math.pi * min(1.0, share))))

    def shapes(self) -> tuple[tuple[int, int], ...]:
        """(h, w) of batches: square, upright and lying, as photographs are."""
        short = max(64, self.size * 3 // 4 // 64 * 64)
        return (self.size, self.size), (self.size, short), (short, self.size)
