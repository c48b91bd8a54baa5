"""From the command line to a task and back to an exit status; every error becomes one line."""

from __future__ import annotations

import logging
import os
import shlex
import sys
import traceback
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

from hydra._internal.utils import get_args_parser
from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig

from experiments import names  # noqa: F401  worker processes of a launcher import this module: they need its resolver
from experiments.command_check import check, check_names
from experiments.command_line import is_sweep, prepare
from experiments.errors import DONE, FAILED, WRONG_INPUT, UserError, is_input_error, one_line
from experiments.pictures import find_file, is_file
from experiments.run_folder import discard, in_sweep, run_folder, save_config, settle
from experiments.sweep_table import write_job
from experiments.termination import gentle, status_of
from treefit.regrowth import GoneError

_log = logging.getLogger(__name__)


def start(main: Callable[[], None]) -> int:
    """Check the command line, run `main` (Hydra's), return the exit status."""
    if "--version" in sys.argv[1:]:
        print(f"treefit {version('treefit')}")
        return DONE
    try:
        sys.argv[1:] = prepare(sys.argv[1:])
        _check(sys.argv[1:])
    except UserError as error:
        say(error)
        return WRONG_INPUT
    try:
        with gentle():
            main()
    except KeyboardInterrupt as stop:  # of a task, `_attempt` has made an end already
        print("stopped", file=sys.stderr)
        return status_of(stop)
    except BrokenPipeError:  # whoever read the output, `head` or a pager, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    return DONE


def run_task(cfg: DictConfig) -> None:
    """Run experiments.<task>; an error ends the program with its exit status, but not a sweep."""
    folder, hydra = run_folder(), HydraConfig.get()
    given = [str(line) for line in hydra.overrides.task]
    if not in_sweep():
        status = _attempt(cfg, given, folder)[0]
        if status != DONE:
            sys.exit(status)
        return
    image = str(find_file(cfg.image, "image")) if cfg.image and is_file(cfg.image) else str(cfg.image or cfg.task)
    write_job(folder, hydra.job.num, given, image, "running")
    status, message = _attempt(cfg, given, folder)
    write_job(folder, hydra.job.num, given, image, "failed" if status else "done", message)


def _attempt(cfg: DictConfig, given: Sequence[str], folder: Path) -> tuple[int, str]:
    """Exit status of the task and the line that was said when it failed."""
    known_folder = (folder / "config.yaml").exists()
    logging.captureWarnings(True)
    try:
        settled = settle(cfg, given)
        if not settled.resume:
            save_config(settled, folder)
        import_module(f"experiments.{settled.task}").run(settled)
    except KeyboardInterrupt as stop:
        print(f"stopped{how_to_go_on(folder)}", file=sys.stderr)
        sys.exit(status_of(stop))
    except Exception as error:
        return _tell(error, bool(cfg.debug), folder, known_folder), one_line(error)
    finally:
        logging.captureWarnings(False)
    return DONE, ""


def how_to_go_on(folder: Path) -> str:
    """Words on how to go on with what is kept in `folder`, "" when nothing is."""
    if any((folder / name).exists() for name in ("checkpoint.npz", "pairs_0000.npz")):
        return f"; to go on: python run.py resume={shlex.quote(str(folder))}"
    if (folder / "runs").is_dir():
        return f"; to go on: the same command with hydra.run.dir={shlex.quote(str(folder))}"
    return ""


def _tell(error: Exception, debug: bool, folder: Path, known_folder: bool) -> int:
    """Say `error` on one line, with the place in the code in run.log; return its exit status."""
    if debug:
        traceback.print_exception(error)
    if is_input_error(error):
        say(error)
        if not known_folder:
            (folder / "config.yaml").unlink(missing_ok=True)
        if not in_sweep():
            discard(folder)
        return WRONG_INPUT
    further = how_to_go_on(folder) if isinstance(error, GoneError) else ""
    _log.error("%s%s (details: %s)", one_line(error), further, folder / "run.log", exc_info=error)
    return FAILED


def _check(arguments: Sequence[str]) -> None:
    flags = get_args_parser().parse_args(list(arguments))
    other_config = flags.config_path or flags.config_name or flags.config_dir
    if other_config or flags.shell_completion:
        return
    if flags.help or flags.hydra_help or flags.cfg or flags.info:
        check_names(flags.overrides, is_sweep(arguments))
    else:
        check(flags.overrides, is_sweep(arguments))


def say(error: BaseException) -> None:
    """Print `error` on one line."""
    print(f"error: {one_line(error)}", file=sys.stderr)
