"""External: a generator that is somebody else's program or function, kept apart in processes of its own (sec. 3)."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, InstanceOf, validate_call

from generators.external.children import Children
from generators.external.digest import Digests
from generators.external.faults import GeneratorFault
from generators.external.limits import GIB, Limits
from generators.external.mesh import Mesh
from generators.external.one_shot import grow_once, is_template
from generators.external.program import program_of
from generators.external.scratch import remove
from generators.external.space import read_space
from generators.external.tree_file import read_tree
from treefit.plant import Budget, ParameterSpace, Plant, Preset, Value, Values, read_presets

Text = Annotated[str, Field(min_length=1)]
Command = Annotated[list[Text], Field(min_length=1)]


class ExternalError(ValueError):
    """What is wrong with the settings of a foreign generator, in one line."""


class External:
    """A generator made of a `command`, a list of a program and its arguments, or a Python `callable` by its name.

    The program is started once a worker and asked by lines of JSON (README of this folder); one whose command has
    {out} in it is started once a tree. `space` is the file of its parameters, by default space.yaml beside it, as
    `presets` is the folder of that name. Seconds of `timeout` and GiB of `memory` are for one tree: to pass them, or
    `max_vertices` (and as many leaves), raises a GeneratorFault. `up` is the axis of arrays that points upwards.
    """

    parallel = "threads"
    pure = False
    family: Path | None = None

    @validate_call(config=ConfigDict(coerce_numbers_to_str=True))
    def __init__(
        self,
        *,
        command: Command | None = None,
        callable: Text | None = None,
        space: Path | InstanceOf[ParameterSpace] | None = None,
        fixed: dict[str, Value] | None = None,
        presets: Path | None = None,
        name: Text | None = None,
        version: Text | None = None,
        size_parameter: Text | None = None,
        age_parameter: Text | None = None,
        timeout: Annotated[float, Field(gt=0, le=3600)] = 10.0,
        memory: Annotated[float, Field(gt=0)] = 4.0,
        max_vertices: Annotated[int, Field(ge=2, le=100_000_000)] = 200_000,
        up: Literal["z", "y"] = "z",
        mesh: InstanceOf[Mesh] | None = None,
    ) -> None:
        self._mesh = mesh or Mesh()
        self._up = up if callable is None else "z"  # the trees of a function are turned by its host
        self._program = program_of(command, callable, up)
        self.name, self.version = name or self._program.name, version or self._program.version
        self.size_parameter, self.age_parameter = size_parameter, age_parameter
        self.limits = Limits(timeout, int(memory * GIB), max_vertices)
        self._fixed = dict(fixed or {})
        self._space_file = self._beside(None if isinstance(space, ParameterSpace) else space, "space.yaml")
        self._presets = self._beside(presets, "presets")
        if isinstance(space, ParameterSpace):
            self.__dict__["space"] = space.fix(**self._fixed)
        if isinstance(space, ParameterSpace) or self._space_file is not None:
            self._check()

    @cached_property
    def space(self) -> ParameterSpace:
        """Parameters that the generator takes; ExternalError when nothing says what they are."""
        if self._space_file is None:
            raise ExternalError(
                f"generator.space: which parameters has {self.name}? Give a file, e.g. generator.space=space.yaml; "
                "task=adapt writes one"
            )
        return read_space(self._space_file).fix(**self._fixed)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Plants of this generator by name, those of its folder."""
        found = read_presets(self._presets) if self._presets is not None else {}
        return {name: replace(one, version=self.version) for name, one in found.items()}

    def with_space(self, space: ParameterSpace) -> External:
        """Return the same generator with another space; both share their processes."""
        other = copy.copy(self)
        other.__dict__.update(space=space, _children=self._children, _digests=self._digests)
        return other

    def __call__(self, values: Values, seed: int, budget: Budget) -> Plant:
        """Plant grown from `values` by name; a GeneratorFault says why there is none."""
        plant = self._grow(values, seed)
        self._digests.check(values, seed, plant)
        return cut(plant, budget)

    def ask_preset(self) -> dict[str, Any] | None:
        """Values of an example plant, as the program tells them; None when it does not know the question."""
        if is_template(self._program.command):
            return None
        try:
            with self._children.one() as child:
                found = child.ask({"ask": "preset"}).get("values")
        except GeneratorFault:
            return None
        return found if isinstance(found, dict) else None

    def close(self) -> None:
        """End its processes and remove what they wrote; the next call starts new ones."""
        children = self.__dict__.pop("_children", None)
        if children is not None:
            children.close()

    def __repr__(self) -> str:
        return f"External({self.name!r}, {' '.join(self._program.command)!r})"

    def __getstate__(self) -> dict[str, object]:
        """State without processes: a copy in another process starts its own."""
        return {name: value for name, value in vars(self).items() if name not in ("_children", "_digests")}

    def __setstate__(self, state: dict[str, object]) -> None:
        """Take a state; all copies of one generator that come to a process share its programs, each task has one."""
        self.__dict__.update(state)
        self.__dict__["_children"], self.__dict__["_digests"] = _of_copies(repr((self._program, self.limits)), self)

    @cached_property
    def _children(self) -> Children:
        return Children(self._program.command, self.limits, self._program.environment)

    @cached_property
    def _digests(self) -> Digests:
        return Digests()

    def _grow(self, values: Values, seed: int) -> Plant:
        command = self._program.command
        if is_template(command):
            folder = self._children.folder()
            try:
                out = grow_once(command, values, seed, folder, self.limits, self._children.environment)
                return read_tree(out, self.limits, self._mesh, self._up)
            finally:
                remove(folder)
        with self._children.one() as child:
            return read_tree(child.grow(values, seed), self.limits, self._mesh, self._up)

    def _beside(self, given: Path | None, name: str) -> Path | None:
        """The path `given`, else that of `name` beside the program, if it is there."""
        own = self._program.home / name
        return given.expanduser().absolute() if given is not None else own if own.exists() else None

    def _check(self) -> None:
        for role in ("size_parameter", "age_parameter"):
            wanted = getattr(self, role)
            names = [parameter.name for parameter in self.space.parameters]
            if wanted is not None and wanted not in names:
                raise ExternalError(f"{role}: no parameter {wanted!r} in the space of {self.name}")
        _ = self.presets


_copies: dict[str, tuple[Children, Digests]] = {}


def _of_copies(key: str, copy: External) -> tuple[Children, Digests]:
    if key not in _copies:
        _copies[key] = Children(copy._program.command, copy.limits, copy._program.environment), Digests()
    return _copies[key]


def cut(plant: Plant, budget: Budget) -> Plant:
    """Return `plant`, or its first vertices and leaves when it has more than the `budget`."""
    if plant.n_vertices <= budget.vertices and plant.n_leaves <= budget.leaves:
        return plant
    v, k = budget.vertices, budget.leaves
    return Plant(
        plant.position[:v], plant.radius[:v], plant.parent[:v], plant.level[:v], plant.leaf_position[:k],
        plant.leaf_axis[:k], plant.leaf_normal[:k], plant.leaf_size[:k], cut=True, complexity=plant.complexity,
    )  # fmt: skip
