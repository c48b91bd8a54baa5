"""live.html and live.js of a run: what the page is made of; names from outside are text in it, never code."""

from __future__ import annotations

import base64
import json
import re
from dataclasses import dataclass, field
from html import escape
from io import BytesIO
from pathlib import Path

from PIL import Image

from experiments.live_curve import curve_svg
from experiments.search_stages import stage_name
from experiments.standing import Panels, Picture
from experiments.terminal import time_left, time_taken
from treefit.improvements import Improvement
from treefit.progress import Generation

Addresses = tuple[str, str]  # of a picture and its mask, with the pictures in them

PAGE, DATA = "live.html", "live.js"
_TEMPLATE = Path(__file__).with_name("live.html")


@dataclass(frozen=True, eq=False)
class Moment:
    """What the page shows at one moment; `patience` are seconds of silence after which a run counts as killed."""

    state: str
    running: bool
    written: float = 0.0  # s since 1970
    patience: float = 0.0
    total: int = 1  # evaluations that the search may take
    history: list[Generation] = field(default_factory=list)
    best: Addresses | None = None
    found: Improvement | None = None  # the one that is drawn
    links: tuple[tuple[str, str], ...] = ()  # words and address
    resume: str = ""  # how to go on when the run was killed


def page_text(title: str, run: str, given: Panels, moment: Moment) -> str:
    """The whole page of a `run`, with `moment` to begin with."""
    height, width = given[0].shape[:2]
    picture, mask = embedded(given)
    filled = {
        "title": escape(title),
        "run": escape(run),
        "given": picture,
        "given_mask": mask,
        "ratio": f"{width / height:.4f}",
        "state": data_text(moment),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: filled[found[1]], _TEMPLATE.read_text(encoding="utf-8"))


def data_text(moment: Moment) -> str:
    """Script that shows `moment` in the page."""
    facts: dict[str, object] = {
        "running": moment.running, "written": moment.written, "patience": moment.patience, "resume": moment.resume,
        "share": 0.0, "words": {"state": moment.state}, "links": moment.links,
    }  # fmt: skip
    if moment.history:
        now = moment.history[-1]
        facts["share"] = min(now.evaluations / moment.total, 1.0)
        facts["words"] = {"state": moment.state, **_words(now, moment)}
        facts["curve"] = curve_svg(moment.history, moment.total if moment.running else now.evaluations)
    if moment.best is not None:
        facts["picture"], facts["mask"] = moment.best
    text = json.dumps(facts, allow_nan=False)
    for letter in "<>&":
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return f"show({text});\n"


def _words(now: Generation, moment: Moment) -> dict[str, str]:
    left = time_left(moment.total - now.evaluations, now.evaluations_per_second).removesuffix(" left")
    drawn = moment.found
    found = f"the best after {drawn.evaluations:,}: {drawn.score:.3f}" if drawn else "the best plant so far"
    return {
        "score": f"{now.best:.4f}",
        "image": f"{now.best_image:.4f}",
        "evaluations": f"{now.evaluations:,}",
        "total": f"{moment.total:,}",
        "rate": f"{now.evaluations_per_second:,.0f}",
        "elapsed": time_taken(now.seconds),
        "left": left if moment.running and now.evaluations < moment.total else "–",
        "stage": stage_name(now.stage),
        "failures": f"{now.failures:,}",
        "found": found,
    }


def embedded(panels: Panels) -> Addresses:
    """Addresses that a page can show without a file."""
    return _address(panels[0], "JPEG"), _address(panels[1], "PNG")


def _address(picture: Picture, kind: str) -> str:
    content = BytesIO()
    Image.fromarray(picture).save(content, kind, **({"quality": 88} if kind == "JPEG" else {}))
    return f"data:image/{kind.lower()};base64,{base64.b64encode(content.getvalue()).decode('ascii')}"
