"""Settings: the values of conf/config.yaml that are no group, with their types and ranges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Literal

from omegaconf import DictConfig, OmegaConf
from pydantic import BeforeValidator, ConfigDict, Field, TypeAdapter, ValidationError, ValidationInfo, field_validator
from pydantic.dataclasses import dataclass

from experiments.adapting.settings import Adapt
from experiments.browse_settings import BrowseSettings
from experiments.check_settings import Check
from experiments.compare_settings import Compare
from experiments.errors import UserError, describe_validation, did_you_mean
from experiments.pictures import examples
from experiments.seeds import SeedList
from experiments.start_settings import MemorySettings, StartNames
from experiments.targets import Modules

GROUPS = (
    "generator",
    "mask",
    "similarity",
    "characteristics",
    "optimizer",
    "view",
    "evaluator",
    "asset",
    "tracking",
)
TASKS = {
    "fit": GROUPS,
    "mask": ("mask",),
    "masks": ("mask",),
    "grow": ("generator", "asset"),
    "sheet": ("generator", "asset"),
    "adapt": ("generator", "asset"),
    "check": ("generator",),
    "benchmark": ("generator", "similarity", "view"),
    "fidelity": ("generator", "similarity", "view"),
    "speed_study": ("generator", "view"),
    "statistics": ("generator", "similarity", "characteristics", "view", "evaluator"),
    "similarities": ("generator", "mask", "similarity", "characteristics", "optimizer", "view", "evaluator"),
    "compare": ("mask", "similarity", "characteristics", "view", "tracking"),
    "browse": ("tracking",),
}
"""Groups that a task builds, by task."""

NEED_IMAGE = ("fit", "mask")

Share = Annotated[float, Field(ge=0, le=1)]
Count = Annotated[int, Field(ge=0)]
Name = Annotated[str, BeforeValidator(lambda value: str(value) if isinstance(value, int | float) else value)]


@dataclass(frozen=True)
class Candidates:
    """How many trees a run ends with, and how different they are."""

    count: Annotated[int, Field(ge=1, le=100)]
    min_distance: Share
    within: Share = 0.08
    runners_up: Annotated[float, Field(ge=0, le=0.9)] = 0.1


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class ObjectiveSettings:
    """How many seeds a score is the mean of, and whether trees race for them."""

    seeds: Annotated[int, Field(ge=1, le=100)] = 1
    racing: bool = True


@dataclass(frozen=True)
class Stop:
    """When the search ends before its budget is used up."""

    score: Share | None
    seconds: Annotated[float, Field(gt=0)] | None


Rows = Annotated[int, Field(ge=64, le=1024)]


@dataclass(frozen=True)
class Fidelity:
    """What the task fidelity looks at."""

    plants: Annotated[int, Field(ge=20, le=10_000)] = 300
    rows: tuple[Rows, ...] = (64, 128, 256)


@dataclass(frozen=True)
class Benchmark:
    """What the task benchmark measures besides the speed of one evaluation."""

    startup: bool = False


@dataclass(frozen=True)
class SpeedStudy:
    """What the task speed_study measures, and where its results go."""

    vertices: Annotated[tuple[Annotated[int, Field(ge=10, le=200_000)], ...], Field(min_length=2)] = (
        1_000, 2_000, 5_000, 10_000, 20_000, 50_000,
    )  # fmt: skip
    rows: Annotated[tuple[Rows, ...], Field(min_length=2)] = (64, 96, 128, 192, 256)
    renew: bool = False


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Variant:
    """What one similarity of the task similarities has otherwise than the configured Mix; terms not named weigh 0."""

    weights: Mapping[str, Annotated[float, Field(ge=0)]] | None = None
    combine: Literal["sum", "product"] | None = None


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Similarities:
    """What the task similarities compares: `names` of the `variants`, all when None, on the files of `masks`."""

    variants: Mapping[Annotated[str, Field(pattern=r"^\w[\w.-]*$")], Variant] = field(default_factory=dict)
    masks: Name | None = None
    names: Annotated[tuple[Name, ...], Field(min_length=1)] | None = None
    evaluations: Annotated[int, Field(ge=1)] = 15_000
    renew: bool = False

    @field_validator("names")
    @classmethod
    def _known(cls, names: tuple[str, ...] | None, info: ValidationInfo) -> tuple[str, ...] | None:
        for name in names or ():
            if name not in info.data.get("variants", ()):
                raise ValueError(f"no similarity {name!r}{did_you_mean(name, info.data.get('variants', ()))}")
        return names


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Statistics:
    """What the task statistics counts: `plants` random plants against `targets`, `steps` of them moved gene by gene."""

    targets: Annotated[int, Field(ge=3, le=500)] = 36
    plants: Annotated[int, Field(ge=10)] = 60_000
    fresh: Annotated[int, Field(ge=10)] = 6_000
    steps: Annotated[int, Field(ge=1)] = 300
    parts: Annotated[int, Field(ge=1, le=100)] = 10
    share: Annotated[float, Field(gt=0, lt=1)] = 0.05
    eps: Share | None = None
    renew: bool = False


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Masks:
    """What the task masks looks at: files that `pictures` matches, beside masks made by hand, `references`.

    By the extractors `methods` as they are in conf, or by the configured one when None.
    """

    pictures: Name | None = None
    references: Name | None = None
    methods: Annotated[tuple[Name, ...], Field(min_length=1)] | None = None


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Sheet:
    """What the task sheet draws: parameters by `names`, all when None; presets on `seeds` seeds; `height` of a cell."""

    names: Annotated[tuple[Name, ...], Field(min_length=1)] | None = None
    seeds: Annotated[int, Field(ge=0, le=12)] = 3
    look: Literal["shaded", "mask", "both"] = "both"
    height: Annotated[int, Field(ge=64, le=512)] = 150


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Strip:
    """What the growth strip of the task grow shows: a plant at `frames` values of `parameter`, its age when None.

    `frames` None is 8 when there is something to show, and none otherwise; `height` is that of a row in pixels.
    """

    frames: Annotated[int, Field(ge=0, le=60)] | None = None
    parameter: Name | None = None
    look: Literal["shaded", "mask", "both"] = "shaded"
    height: Annotated[int, Field(ge=64, le=1024)] = 260
    animation: bool = False


@dataclass(frozen=True)
class Settings:
    """Values of the run itself; files are names as the user gave them."""

    task: str
    image: Name | None
    seed: Annotated[int, Field(ge=0, lt=2**63)]
    debug: bool
    candidates: Candidates
    other_seeds: Annotated[int, Field(ge=0, le=1000)]
    stop: Stop
    resume: Name | None
    preset: Name | None
    values: dict[str, bool | int | float | str]
    start: StartNames = ()
    memory: MemorySettings = MemorySettings()
    fidelity: Fidelity = Fidelity()
    benchmark: Benchmark = Benchmark()
    speed_study: SpeedStudy = SpeedStudy()
    similarities: Similarities = field(default_factory=Similarities)
    compare: Compare = field(default_factory=Compare)
    statistics: Statistics = field(default_factory=Statistics)
    objective: ObjectiveSettings = field(default_factory=ObjectiveSettings)
    seeds: SeedList = None
    live: bool = False
    modules: Modules = ()
    masks: Masks = field(default_factory=Masks)
    adapt: Adapt = Adapt()
    check: Check = Check()
    sheet: Sheet = field(default_factory=Sheet)
    strip: Strip = field(default_factory=Strip)
    browse: BrowseSettings = field(default_factory=BrowseSettings)

    @field_validator("task")
    @classmethod
    def _known(cls, task: str) -> str:
        if task not in TASKS:
            raise ValueError(f"no task {task!r}{did_you_mean(task, TASKS)}")
        return task


def read_settings(cfg: DictConfig) -> Settings:
    """Return the Settings in `cfg`; UserError for a wrong type or range, and when no picture is given."""
    whole = OmegaConf.to_container(cfg, resolve=True)
    assert isinstance(whole, dict)
    values = {name: whole[name] for name in Settings.__dataclass_fields__ if name in whole}
    try:
        settings = TypeAdapter(Settings).validate_python(values)
    except ValidationError as error:
        raise UserError(describe_validation(error, "")) from error
    if settings.task in NEED_IMAGE and settings.image is None and settings.resume is None:
        shown = ", ".join(examples())
        raise UserError(f"image: which picture? e.g. image=pine.png (examples: {shown}) or the path of yours")
    return settings
