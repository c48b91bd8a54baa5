"""Pages of treefit in pictures: what each shows when it is there, and what is wiped from it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from PIL import Image

from scripts.headless_browser import HeadlessBrowser

BEFORE = """
localStorage.setItem("mlflow.assistant.panelOpen_v1", "false");
localStorage.setItem("mlflow.assistant.fab.autoOpenedOnFirstLoad_v1", "true");
"""
"""In every page of mlflow: its chat is closed."""

UNFOLD = "document.querySelector('[data-component-id*=runnamecellrenderer]').click()"
"""Shows the runs of the newest sweep below it."""

WIPE = """
for (const one of document.querySelectorAll("span, div"))
  if (!one.children.length && /file:\\/\\//.test(one.textContent)) one.style.visibility = "hidden";
for (const one of document.querySelectorAll("[aria-label*=ssistant]")) one.style.visibility = "hidden";
"""
"""Takes away where files lie on the machine that made the picture."""

COLOURS = 255
MOST_BYTES = 250_000


@dataclass(frozen=True)
class Page:
    """A page: file name of its picture, address, JavaScript that holds when it is whole, size, s until it stands.

    `then` is JavaScript that is done once it is whole.
    """

    name: str
    url: str
    shows: str
    size: tuple[int, int] = (1280, 800)
    settle: float = 2.0
    then: str = ""


def take(browser: HeadlessBrowser, page: Page, folder: Path) -> Path:
    """Write the picture of `page` to `folder`; return its file."""
    browser.resize(*page.size)
    browser.open(page.url, page.shows)
    browser.value(f"{page.then};{WIPE}")
    return save(browser.picture(page.settle), folder / page.name)


def save(image: Image.Image, file: Path) -> Path:
    """Write `image` with few colours, smaller where it would still be too heavy for a README."""
    while True:
        small = image.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        small.save(file, optimize=True)
        if file.stat().st_size <= MOST_BYTES or image.width < 800:
            return file
        image = image.resize((image.width * 9 // 10, image.height * 9 // 10), Image.Resampling.LANCZOS)
