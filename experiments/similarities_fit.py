"""JudgedFit: the best tree for one picture by one similarity, judged; how it is searched, and kept in a folder."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, cast

from omegaconf import DictConfig, OmegaConf

from experiments.build import build
from treefit.fit import Result, fit
from treefit.image import write_mask
from treefit.image.read import read_mask_file
from treefit.mask import Mask
from treefit.similarity import Mix
from treefit.similarity.measures import Agreement


@dataclass(frozen=True, eq=False)
class JudgedFit:
    """One fit: how its tree agrees with the target, itself and as mean on other seeds, and its mask at 256 rows."""

    picture: str
    similarity: str
    score: float
    score_other_seeds: float | None
    seconds: float
    agreement: Agreement
    agreement_other_seeds: Agreement | None
    mask: Mask

    @classmethod
    def of(cls, picture: str, similarity: str, result: Result) -> JudgedFit:
        """Return the best candidate of `result`."""
        best = result.candidates[0]
        return cls(picture, similarity, best.score.total, best.score_other_seeds, result.seconds, best.agreement,
                   best.agreement_other_seeds, best.mask)  # fmt: skip

    @property
    def facts(self) -> dict[str, Any]:
        """Everything but the mask, for JSON."""
        numbers = ("picture", "similarity", "score", "score_other_seeds", "seconds")
        other = self.agreement_other_seeds
        return {name: getattr(self, name) for name in numbers} | {
            "agreement": asdict(self.agreement), "agreement_other_seeds": asdict(other) if other else None,
        }  # fmt: skip


@dataclass(frozen=True, eq=False)
class Search:
    """Fits masks by similarities; `settings` says all else that the result depends on."""

    generator: str
    settings: str
    parts: Mapping[str, Any]

    @classmethod
    def of(cls, cfg: DictConfig, evaluations: int) -> Search:
        """Return the search of a configuration, but with so many `evaluations`."""
        cfg = cast(DictConfig, OmegaConf.merge(cfg, {"optimizer": {"evaluations": evaluations}}))
        names = ("generator", "characteristics", "view", "optimizer", "evaluator")
        parts: dict[str, Any] = {name: build(cfg[name], name) for name in names}
        parts |= {"seed": int(cfg.seed), "other_seeds": int(cfg.other_seeds)}
        generator = f"{parts['generator'].name} {parts['generator'].version}"
        settings = {name: str(cfg[name]) for name in parts if name != "evaluator"}
        return cls(generator, json.dumps([generator, settings]), parts)

    def __call__(self, mask: Mask, similarity: Mix) -> Result:
        """Result for a mask (h, w), with one candidate."""
        return fit(mask, similarity=similarity, candidates=1, **self.parts)


@dataclass(frozen=True, eq=False)
class Study:
    """All fits so far; `targets` are masks as the fits' own are: 256 rows, the trunk base in the middle column."""

    generator: str
    evaluations: int
    seed: int
    other_seeds: int
    mixes: Mapping[str, Mix]
    targets: Mapping[str, Mask]
    fits: Sequence[JudgedFit]

    @property
    def by_pair(self) -> dict[tuple[str, str], JudgedFit]:
        """Fits by picture and similarity."""
        return {(fit.picture, fit.similarity): fit for fit in self.fits}

    @property
    def pictures(self) -> list[str]:
        """Pictures that have a fit, in the order of the targets."""
        return [name for name in self.targets if any(fit.picture == name for fit in self.fits)]


def keep(found: JudgedFit, folder: Path, settings: str) -> None:
    """Write `found` and the `settings` that it came from to `folder`; the JSON last, it says that the fit is whole."""
    json_file, mask_file = _files(folder, found.picture, found.similarity)
    mask_file.parent.mkdir(parents=True, exist_ok=True)
    write_mask(found.mask, mask_file)
    unfinished = json_file.with_suffix(".tmp")
    unfinished.write_text(json.dumps({"settings": settings, **found.facts}, indent=1), encoding="utf-8")
    unfinished.replace(json_file)


def kept(folder: Path, picture: str, similarity: str, settings: str) -> JudgedFit | None:
    """Fit that is kept in `folder`; None when there is none of the same `settings`."""
    json_file, mask_file = _files(folder, picture, similarity)
    if not json_file.exists():
        return None
    facts: dict[str, Any] = json.loads(json_file.read_text(encoding="utf-8"))
    if facts.pop("settings") != settings:
        return None
    for name in ("agreement", "agreement_other_seeds"):
        facts[name] = _agreement(facts[name])
    return JudgedFit(**facts, mask=read_mask_file(mask_file))


def _agreement(numbers: Mapping[str, float] | None) -> Agreement | None:
    return None if numbers is None else Agreement(**numbers)


def _files(folder: Path, picture: str, similarity: str) -> tuple[Path, Path]:
    place = folder / "fits" / picture
    return place / f"{similarity}.json", place / f"{similarity}.png"
