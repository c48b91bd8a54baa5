"""A generator as a foreign program, which misbehaves as it is told to in a share of its calls.

python tree_program.py [--how KIND] [--share 0.1] [--millis 20], or --list. Which calls are bad depends on their values
and seed alone; values may also name a kind themselves, by `how`.
"""

import argparse
import json
import sys
import time
import zlib
from pathlib import Path

from hostile.call import Call
from hostile.kinds import KINDS
from hostile.tree import grow

PRESET = {"height": 10.0, "branches": 40, "angle": 70.0, "reach": 0.3, "leaf_size": 0.4}


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--how", choices=("well", *KINDS), default="well")
    parser.add_argument("--share", type=float, default=1.0)
    parser.add_argument("--millis", type=float, default=0.0, help="CPU time that a tree takes")
    parser.add_argument("--list", action="store_true", help="print the kinds and what they do, and end")
    options = parser.parse_args()
    if options.list:
        sys.stdout.write(json.dumps({name: str(kind.__doc__) for name, kind in KINDS.items()}))
        return
    while line := sys.stdin.readline():
        serve(json.loads(line), options)


def serve(request: dict, options: argparse.Namespace) -> None:
    if "ask" in request:
        sys.stdout.write(json.dumps({"id": request["id"], "ok": True, "values": PRESET}) + "\n")
        sys.stdout.flush()
        return
    ends = time.process_time() + options.millis / 1000
    values, seed = dict(request["values"]), request["seed"]
    how = values.pop("how", None) or (options.how if chance(values, seed) < options.share else "well")
    call = Call(request["id"], Path(request["out"]).with_suffix(".npz"), grow(values, seed))
    while time.process_time() < ends:
        pass
    if how != "well":
        KINDS[how](call)
    else:
        call.write(call.tree)
        call.answer()


def chance(values: dict, seed: int) -> float:
    """Number in [0, 1) that depends on `values` and `seed` alone."""
    return zlib.crc32(json.dumps([seed, values], sort_keys=True).encode()) / 2**32


if __name__ == "__main__":
    main()
