"""Measures of the task masks: how near the mask of an extractor is to one made by hand."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.image import Extraction, Extractor, Picture
from treefit.mask import BACKGROUND, BRANCH, FOLIAGE, Mask

MEASURES = {"tree": "tree IoU", "classes": "3-class IoU", "branch": "branch IoU"}


@dataclass(frozen=True, eq=False)
class Found:
    """What the extractor `method` made of the picture `name` in `seconds` of processor time, or why it could not."""

    name: str
    method: str
    extraction: Extraction | None
    seconds: float
    error: str = ""
    agreement: Mapping[str, float] | None = None

    @classmethod
    def of(cls, name: str, picture: Picture, method: str, extractor: Extractor, reference: Mask | None) -> Found:
        """Run `extractor`; compare with `reference`, a mask of the same size, if any: no mask counts 0 then."""
        started = time.process_time()
        try:
            extraction = extractor(picture)
        except Exception as error:  # a picture without a tree must not end the others
            nothing = None if reference is None else dict.fromkeys(MEASURES, 0.0)
            return cls(name, method, None, time.process_time() - started, " ".join(str(error).split()), nothing)
        seconds = time.process_time() - started
        told = None if reference is None else agreement(extraction.mask, reference)
        return cls(name, method, extraction, seconds, "", told)


def agreement(mask: Mask, reference: Mask) -> dict[str, float]:
    """IoU of `tree` against background, mean IoU of the three `classes`, and IoU of `branch`.

    A class that neither mask has is left out of the mean; `branch` is nan then.
    """
    each = [iou(mask == kind, reference == kind) for kind in (BACKGROUND, BRANCH, FOLIAGE)]
    return {
        "tree": iou(mask != BACKGROUND, reference != BACKGROUND),
        "classes": float(np.nanmean(each)),
        "branch": each[BRANCH],
    }


def iou(one: NDArray[np.bool_], two: NDArray[np.bool_]) -> float:
    """Intersection over union; nan when both are empty."""
    union = np.count_nonzero(one | two)
    return np.count_nonzero(one & two) / union if union else float("nan")
