"""The extractor of the configuration: what looks at pictures, with what the user says of them."""

from __future__ import annotations

from typing import cast

from omegaconf import DictConfig, OmegaConf
from pydantic import ValidationError

from experiments.build import build
from experiments.errors import UserError, describe_validation
from experiments.targets import opted_in
from treefit.image import Extractor, FileMask, Help, HelpedMask

HELP = tuple(Help.__dataclass_fields__)


def build_extractor(cfg_node: DictConfig, place: str) -> Extractor:
    """Extractor that the group `cfg_node` describes; UserError as from `build`, and for help that cannot be."""
    settings = OmegaConf.to_container(cfg_node, resolve=True)
    assert isinstance(settings, dict)
    given = {name: settings[name] for name in HELP if settings.get(name) is not None}
    rest = {str(name): value for name, value in settings.items() if name not in HELP}
    extractor = cast(Extractor, build(OmegaConf.create(rest), place, opted_in(cfg_node)))
    if not given:
        return extractor
    if isinstance(extractor, FileMask):
        name = next(iter(given))
        raise UserError(f"{place}.{name}: the file of mask=file is taken as it is; correct it, or leave out mask=file")
    try:
        return HelpedMask(extractor, Help(**given))
    except ValidationError as error:
        raise UserError(describe_validation(error, place, HELP)) from error
