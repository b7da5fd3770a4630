"""Exceptions. Each leaves scenes and simulations as they were."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from eem._record import Record


class Fault(NamedTuple):
    """A mistake in a text of a material, with its place."""

    #: the text in which it is: ``"psi"``, ``"viscosity of `gamma`"``, ``"unit of `k`"``
    part: str
    #: counted from 1
    line: int
    #: in characters, from 1
    column: int
    #: characters from there on
    width: int
    #: what is wrong
    text: str
    #: what to write instead
    help: str
    #: the calls of helper functions in which it is wrong
    calls: list[str]


class EemError(Exception):
    """An error of this package."""


class MaterialError(EemError, ValueError):
    """A material that cannot be. The message draws every mistake at its place."""

    #: all mistakes, in the order of the text; empty if it is not the text that is wrong
    faults: list[Fault]

    def __init__(self, message: str = "", *, faults: list[Fault] | None = None) -> None:
        super().__init__(message)
        self.faults = faults or []


class SceneError(EemError, ValueError):
    """A scene, a state or an argument that cannot be."""

    #: everything that is wrong
    errors: list[str]

    def __init__(self, message: str = "", *, errors: list[str] | None = None) -> None:
        super().__init__(message)
        self.errors = errors or []


class StepError(EemError, RuntimeError):
    """A step that was not made. The simulation is as it was before it."""

    #: when the step began, s
    time: float
    #: its size, s
    step: float
    #: a shorter step that works, s, if one was found
    shorter: float | None
    #: why it failed: ``"NotConverged"``, ``"LawNotKept"``, …
    failure: str
    #: residual (N s) and scaled update of each iteration of Newton's method, in all attempts
    newton: list[tuple[float, float]]
    #: the law that it would have broken, if that is why, …
    law: str | None
    #: … by how much, …
    defect: float | None
    #: … and how much rounding explains
    bound: float | None
    #: the steps before it, if they were recorded
    record: Record | None

    def __init__(
        self,
        message: str = "",
        *,
        time: float = float("nan"),
        step: float = float("nan"),
        shorter: float | None = None,
        failure: str = "",
        newton: list[tuple[float, float]] | None = None,
        law: str | None = None,
        defect: float | None = None,
        bound: float | None = None,
        record: Record | None = None,
    ) -> None:
        super().__init__(message)
        self.time = time
        self.step = step
        self.shorter = shorter
        self.failure = failure
        self.newton = newton or []
        self.law = law
        self.defect = defect
        self.bound = bound
        self.record = record


class GradientError(EemError, RuntimeError):
    """A run or a quantity without derivatives. The simulation is as it was."""

    #: why: ``"NoHistory"``, ``"NoAdjoint"``, ``"NotAnEndOfStep"``, …
    reason: str

    def __init__(self, message: str = "", *, reason: str = "") -> None:
        super().__init__(message)
        self.reason = reason


class EquilibriumError(EemError, RuntimeError):
    """No stable state at rest was found. The scene is as it was."""


class CheckpointError(EemError, ValueError):
    """A checkpoint of another scene or scheme, or none at all. The simulation is as it was."""
