"""Task similarities: which similarity gives the best fits, judged by measures beside the search, and by eye.

`similarities.renew=true` copies the table of numbers to the repository. The sheet always stays in the run's folder: its
masks may have been made from photographs of others.
"""

from __future__ import annotations

import hashlib
import json
import logging
import sys
from dataclasses import replace
from pathlib import Path

from hydra.core.hydra_config import HydraConfig
from omegaconf import DictConfig
from PIL import Image
from pydantic import ValidationError

from experiments.build import build
from experiments.errors import UserError, describe_validation, one_line
from experiments.numbers import rounded
from experiments.run_folder import run_folder
from experiments.settings import Variant, read_settings
from experiments.similarities_fit import JudgedFit, Search, Study, keep, kept
from experiments.similarities_page import means, page
from experiments.similarities_sheet import sheet
from experiments.similarities_targets import read_targets
from treefit.candidates import REPORT_HEIGHT
from treefit.mask import Mask
from treefit.regrowth import SearchError
from treefit.similarity import Mix
from treefit.view import frame_for, sample

_log = logging.getLogger(__name__)


def run(cfg: DictConfig) -> None:
    """Fit every picture by every similarity; write similarities.md, similarities.json and similarities.png.

    What a run in the same folder (`hydra.run.dir=`) has found before, by the same settings, is not searched anew.
    """
    folder, settings = run_folder(), read_settings(cfg)
    wanted = settings.similarities
    base = build(cfg.similarity, "similarity")
    mixes = {name: vary(base if isinstance(base, Mix) else Mix(), wanted.variants[name], name)
             for name in wanted.names or wanted.variants}  # fmt: skip
    targets = read_targets(wanted.masks, cfg.mask)
    resolution = int(cfg.view.resolution)
    shown = {name: sample(mask, frame_for(mask, resolution).finer(REPORT_HEIGHT)) for name, mask in targets.items()}
    search = Search.of(cfg, wanted.evaluations)
    fits: list[JudgedFit] = []
    pairs = [(picture, name) for picture in targets for name in mixes]
    for i, (picture, name) in enumerate(pairs):
        found = _find(folder, picture, name, targets[picture], mixes[name], search, f"{i + 1}/{len(pairs)}")
        fits += [found] if found else []
        if fits and name == list(mixes)[-1]:
            study = Study(search.generator, wanted.evaluations, settings.seed, settings.other_seeds, mixes, shown, fits)
            _write(study, folder, renew=wanted.renew and i + 1 == len(pairs))
    if not fits:
        raise SearchError("similarities: no fit succeeded, the lines above say why")
    files = {"table": str(folder / "similarities.md"), "sheet": str(folder / "similarities.png")}
    print(json.dumps({**files, "fits": len(fits), "failed": len(pairs) - len(fits)}), flush=True)


def vary(base: Mix, variant: Variant, name: str) -> Mix:
    """`base` with what `variant` has otherwise; terms whose weights it does not name weigh 0."""
    weights = base.weights if variant.weights is None else {**dict.fromkeys(base.terms, 0.0), **variant.weights}
    try:
        return replace(base, weights=weights, combine=variant.combine or base.combine)
    except ValidationError as error:
        raise UserError(describe_validation(error, f"similarities.variants.{name}")) from error


def _find(folder: Path, picture: str, name: str, mask: Mask, mix: Mix, search: Search, count: str) -> JudgedFit | None:
    """Fit that is kept, or a new one, told in a line; None when it failed."""
    settings = hashlib.sha256(f"{search.settings}{mix}{mask.shape}".encode() + mask.tobytes()).hexdigest()
    found = kept(folder, picture, name, settings)
    remark = "kept" if found else ""
    if found is None:
        try:
            found = JudgedFit.of(picture, name, search(mask, mix))
        except Exception as error:  # one fit that cannot be had must not end the others
            _log.warning("%s %s by %s: failed: %s", count, picture, name, one_line(error), exc_info=error)
            return None
        keep(found, folder, settings)
        remark = f"{found.seconds:.1f} s"
    told = found.agreement
    measures = f"silhouette {told.silhouette_iou:.2f}, class {told.class_iou:.2f}, texture {told.texture:.2f}"
    print(f"{count} {picture} by {name}: {measures}, {remark}", file=sys.stderr, flush=True)
    return found


def _write(study: Study, folder: Path, renew: bool) -> None:
    """Write what is known so far, the table to the repository too when it is to `renew` the one there."""
    text = page(study, [str(one) for one in HydraConfig.get().overrides.task])
    for place in [folder, *([Path(__file__).parent] if renew else [])]:
        (place / "similarities.md").write_text(text, encoding="utf-8")
    facts = {"means": means(study), "fits": [fit.facts for fit in study.fits]}
    (folder / "similarities.json").write_text(json.dumps(rounded(facts, 4), indent=1), encoding="utf-8")
    Image.fromarray(sheet(study)).save(folder / "similarities.png", optimize=True)
