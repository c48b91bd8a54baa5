"""Files that are there as a whole or not at all: written under another name, then renamed."""

from __future__ import annotations

from pathlib import Path


def write_whole(path: Path | str, content: bytes) -> None:
    """Write `content` to `path` at once or not at all."""
    path = Path(path)
    unfinished = path.with_name(path.name + ".tmp")
    try:
        unfinished.write_bytes(content)
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)
