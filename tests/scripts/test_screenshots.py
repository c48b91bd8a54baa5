from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from scripts import screenshot_pages
from scripts.headless_browser import BrowserError, find_browser
from scripts.screenshot_pages import save


def test_picture_of_a_page_is_light_enough_for_a_readme(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screenshot_pages, "MOST_BYTES", 70_000)
    noise = np.random.default_rng(0).integers(0, 256, (100, 1000, 3), np.uint8)
    file = save(Image.fromarray(noise), tmp_path / "page.png")
    with Image.open(file) as page:
        assert page.mode == "P"
        assert 700 < page.width < 1000
    plain = save(Image.new("RGB", (1280, 800), "white"), tmp_path / "plain.png")
    with Image.open(plain) as page:
        assert page.size == (1280, 800)


def test_missing_browser_is_said_with_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(BrowserError, match="no browser: install one of chromium"):
        find_browser()
