"""HeadlessBrowser: Chromium without a display, told what to do through a pipe, for pictures of pages."""

from __future__ import annotations

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from io import BytesIO
from types import TracebackType

from PIL import Image

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
    "--remote-debugging-pipe",
)  # fmt: skip
SECONDS = 60.0
"""How long a page may take to show what is waited for."""


class BrowserError(RuntimeError):
    """The browser is missing, or a page did not show what it should."""


def find_browser() -> str:
    """Path of the browser; BrowserError when there is none."""
    program = next((path for name in NAMES if (path := shutil.which(name))), None)
    if program is None:
        raise BrowserError(f"no browser: install one of {', '.join(NAMES)} (Debian: apt install chromium)")
    return program


class HeadlessBrowser:
    """One page of `width` x `height` pixels. Use in `with`; `before` is run in every page before its own scripts."""

    def __init__(self, width: int, height: int, before: str = "") -> None:
        self._size, self._before = (width, height), before
        self._number = 0

    def __enter__(self) -> HeadlessBrowser:
        program = find_browser()
        self._profile = tempfile.TemporaryDirectory(prefix="browser_", ignore_cleanup_errors=True)
        (here, theirs), (answers, ours) = os.pipe(), os.pipe()  # what we say; what it answers
        command = [
            program,
            *FLAGS,
            f"--user-data-dir={self._profile.name}",
            f"--window-size={self._size[0]},{self._size[1]}",
        ]

        def at_three_and_four() -> None:  # where Chromium reads and writes
            first, second = os.dup(here), os.dup(ours)
            os.dup2(first, 3)
            os.dup2(second, 4)

        self._process = subprocess.Popen(
            [*command, "about:blank"], preexec_fn=at_three_and_four, close_fds=False,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(here)
        os.close(ours)
        self._say, self._hear = theirs, answers
        self._rest = b""
        self._session: str | None = None
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = str(self._ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"])
        self._ask("Page.enable")
        self.resize(*self._size)
        if self._before:
            self._ask("Page.addScriptToEvaluateOnNewDocument", source=self._before)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._say)
        os.close(self._hear)
        self._profile.cleanup()

    def resize(self, width: int, height: int) -> None:
        """Give the page another size."""
        self._ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def open(self, url: str, shows: str, seconds: float = SECONDS) -> None:
        """Open `url` and wait until the JavaScript condition `shows` holds, then until the page stands still."""
        self._ask("Page.navigate", url="about:blank")
        self._ask("Page.navigate", url=url)
        self.wait(shows, seconds)

    def wait(self, shows: str, seconds: float = SECONDS) -> None:
        """Wait until the JavaScript condition `shows` holds."""
        end = time.monotonic() + seconds
        while not self.value(f"!!({shows})"):
            if time.monotonic() > end:
                raise BrowserError(f"the page did not show {shows} within {seconds:.0f} s")
            time.sleep(0.2)

    def value(self, javascript: str) -> object:
        """Value of an expression in the page; None when it fails."""
        answer = self._ask("Runtime.evaluate", expression=javascript, returnByValue=True, awaitPromise=True)
        result = answer["result"]
        assert isinstance(result, dict)
        return result.get("value")

    def picture(self, settle: float = 1.0) -> Image.Image:
        """Picture of what the page shows after `settle` seconds."""
        time.sleep(settle)
        data = str(self._ask("Page.captureScreenshot", format="png")["data"])
        return Image.open(BytesIO(base64.b64decode(data))).convert("RGB")

    def _ask(self, method: str, **params: object) -> dict[str, object]:
        self._number += 1
        message: dict[str, object] = {"id": self._number, "method": method, "params": params}
        if self._session is not None:
            message["sessionId"] = self._session
        os.write(self._say, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']}")
                result = answer["result"]
                assert isinstance(result, dict)
                return result

    def _next(self) -> dict[str, object]:
        while b"\0" not in self._rest:
            read = os.read(self._hear, 1 << 20)
            if not read:
                raise BrowserError("the browser has ended")
            self._rest += read
        line, _, self._rest = self._rest.partition(b"\0")
        answer = json.loads(line)
        assert isinstance(answer, dict)
        return answer
