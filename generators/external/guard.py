"""Guard: a process that ends foreign programs and clears their folder when who started them is gone without a word.

`python guard.py mark folder`, run as a file; its input ends with the process that it waits for.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

_PROJECT = Path(__file__).parents[2]


def start_guard(mark: str, folder: Path) -> subprocess.Popen[bytes]:
    """Start one over the programs that carry `mark` and write below `folder`; it is to be killed when they are gone."""
    command, nowhere = [sys.executable, __file__, mark, str(folder)], subprocess.DEVNULL
    return subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=nowhere, stderr=nowhere, start_new_session=True, cwd=_PROJECT,
        env={**os.environ, "PYTHONPATH": str(_PROJECT)},
    )  # fmt: skip


def main(mark: str, folder: str) -> None:
    """Wait for the end of the input, then see to it that nothing is left."""
    sys.path.pop(0)  # where this file is: it has names that others have too
    from generators.external.marks import end_marked
    from generators.external.scratch import remove

    since = time.time() - 60.0
    sys.stdin.buffer.read()
    end_marked(mark, since)
    remove(Path(folder))


if __name__ == "__main__":
    main(*sys.argv[1:])
