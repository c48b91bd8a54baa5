"""BrowseSettings: how task=browse shows the runs."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class BrowseSettings:
    """Whether a browser is opened, auto: when there is a display; `port` of the pages, None: a free one."""

    open: bool | Literal["auto"] = "auto"
    port: Annotated[int, Field(ge=1, le=65535)] | None = None
