"""Log: what a training says while it runs: lines on the terminal, log.jsonl, loss.png."""

from __future__ import annotations

import json
import time
from pathlib import Path

Entry = dict[str, float]


class Log:
    """Lines {step, loss, rate, seconds} and {step, loss, iou_...} of validations, in `folder`/log.jsonl."""

    def __init__(self, folder: Path, steps: int, step: int, end: float) -> None:
        self.path = folder / "log.jsonl"
        self._steps, self._first, self._end = steps, step, end
        self._begin = time.monotonic()
        self.entries: list[Entry] = []
        if self.path.exists():  # what came after the checkpoint is done again
            lines = [json.loads(line) for line in self.path.read_text(encoding="utf-8").splitlines()]
            self.entries = [entry for entry in lines if entry["step"] <= step]
        self.path.write_text("".join(json.dumps(entry) + "\n" for entry in self.entries), encoding="utf-8")

    def stepped(self, step: int, loss: float, rate: float) -> None:
        """Note one step, with the time left by the pace so far and by the clock."""
        seconds = time.monotonic() - self._begin
        left = (self._steps - step) * seconds / max(1, step - self._first)
        clock = self._end - time.monotonic()
        self._write({"step": step, "loss": round(loss, 5), "rate": rate, "seconds": round(seconds, 1)})
        self.say(f"step {step}/{self._steps}  loss {loss:.4f}  rate {rate:.2e}  {left:.0f} s left of {clock:.0f} s")

    def validated(self, step: int, scores: Entry) -> None:
        """Note a validation and draw both curves anew."""
        self._write({"step": step, **{name: round(value, 5) for name, value in scores.items()}})
        self.say("held out: " + "  ".join(f"{name} {value:.3f}" for name, value in scores.items()))
        draw(self.entries, self.path.with_name("loss.png"))

    def say(self, line: str) -> None:
        """Print one line at once."""
        print(line, flush=True)

    def _write(self, entry: Entry) -> None:
        self.entries.append(entry)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(entry) + "\n")


def draw(entries: list[Entry], path: Path) -> None:
    """Plot the losses of training and held-out scenes, and the IoU of each class, over the steps."""
    from matplotlib.figure import Figure  # takes a second, which a training of two steps need not wait for

    learned = [entry for entry in entries if "rate" in entry]
    judged = [entry for entry in entries if "rate" not in entry]
    figure = Figure(figsize=(10, 4), layout="constrained")
    losses, scores = figure.subplots(1, 2)
    losses.plot([entry["step"] for entry in learned], [entry["loss"] for entry in learned], lw=0.8, label="training")
    losses.plot([entry["step"] for entry in judged], [entry["loss"] for entry in judged], label="held-out scenes")
    losses.set(xlabel="step", ylabel="cross-entropy + Dice loss", yscale="log")
    for name in (name for name in judged[-1] if name.startswith("iou_")):
        scores.plot([entry["step"] for entry in judged], [entry[name] for entry in judged], label=name[4:])
    scores.set(xlabel="step", ylabel="IoU of held-out scenes", ylim=(0, 1))
    for axes in (losses, scores):
        axes.legend()
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=110)
