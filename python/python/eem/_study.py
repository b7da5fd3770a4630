"""What schemes cost, and how accurate they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from eem._eem import KINDS
from eem._errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from eem._eem import Studied
    from eem._errors import StepError


@dataclass(frozen=True, eq=False)
class StudyRow:
    """A setting of a study: what it costs, how accurate it is at the end, and how well it keeps the laws.

    Errors are relative: max |Δq|/|q|₂, max |Δp|/max |p|₂ with the largest momentum on the way, max |Δθ|/θ and max |Δγ|/|q|₂. None is
    stated where there is no such quantity, where the run failed, or where the two references differ by more than a hundredth of it.
    """

    #: the name of the scheme
    scheme: str
    #: the constant step, s
    step: float | None
    #: the tolerance of step control
    tolerance: float | None
    #: of positions
    error_q: float | None
    #: of momenta
    error_p: float | None
    #: of temperatures
    error_theta: float | None
    #: of viscous stretches
    error_gamma: float | None
    #: the largest of them; it can be stated even if a much smaller one is not
    largest_error: float | None
    #: quantities whose error is not stated: the difference from the first reference, and that of the references
    refused: dict[str, tuple[float, float]] = field(repr=False)
    #: the largest error of the balance of energy, relative to the energy at the start
    energy_defect: float
    #: the largest bound for rounding in a step, relative to it
    step_bound: float
    #: the smallest change of the entropy in a step, J/K
    least_entropy_change: float
    #: accepted steps
    steps: int
    #: rejected steps
    rejected: int
    #: iterations of Newton's method
    iterations: int
    #: evaluations of the forces of all springs
    evaluations: int
    #: the time of the steps alone, the least of all repeats, s
    seconds: float
    #: the median of the repeats, s
    median_seconds: float
    #: the time of making the scene and the simulation, s
    setup_seconds: float
    #: why the run did not reach the end
    failure: StepError | None

    def error(self, quantity: str) -> float | None:
        """The error of ``"q"``, ``"p"``, ``"theta"`` or ``"gamma"``, if it is stated."""
        if quantity not in KINDS:
            raise SceneError(f"a study has no errors of {quantity!r}: take one of {', '.join(KINDS)}")
        found: float | None = getattr(self, f"error_{quantity}")
        return found


@dataclass(frozen=True)
class Recommendation:
    """What to take for an accuracy; `str` says it in words."""

    #: the largest relative error that is allowed
    accuracy: float
    #: in these quantities
    quantities: tuple[str, ...]
    #: the fastest setting of all that are accurate enough, even with the difference of the references added to their errors
    fastest: StudyRow | None
    #: the fastest of them whose scheme proves energy, entropy and momenta in every step
    lawful: StudyRow | None
    #: the most accurate setting, if none is accurate enough
    closest: StudyRow | None
    #: the quantity in which the references differ by more than a hundredth of the accuracy, and by how much
    refused: tuple[str, float] | None
    _text: str = field(repr=False)

    def __str__(self) -> str:
        return self._text


class StudyReport:
    """The settings of a study, made by `Scene.study`; `str` is a table with recommendations."""

    #: the time from the start at which states are compared, s
    duration: float
    #: a row for each setting
    rows: tuple[StudyRow, ...]

    def __init__(self, duration: float, rows: list[StudyRow], found: Studied) -> None:
        self.duration = duration
        self.rows = tuple(rows)
        self._found = found

    @property
    def front(self) -> list[StudyRow]:
        """The rows that no other row beats in both time and largest error, from the fastest to the most accurate."""
        return [self.rows[place] for place in self._found.front()]

    def order(self, scheme: str, quantity: str = "q") -> float | None:
        """The observed order of a scheme: the slope between the two smallest steps with stated errors, if there are two."""
        return self._found.order(scheme, quantity)

    def recommend(self, accuracy: float, quantities: str | Sequence[str] = KINDS) -> Recommendation:
        """The fastest settings whose relative errors are at most so large, in these quantities."""
        quantities = (quantities,) if isinstance(quantities, str) else tuple(quantities)
        text, places, refused = self._found.recommend(accuracy, list(quantities))
        fastest, lawful, closest = (None if place is None else self.rows[place] for place in places)
        return Recommendation(accuracy, quantities, fastest, lawful, closest, refused, text)

    def csv(self) -> str:
        """A line for each row, below heads; errors that are not stated are empty."""
        return self._found.csv()

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """Columns by name, for tables; what a row does not have is NaN. Failures are left out."""
        columns: dict[str, NDArray[Any]] = {}
        for own in fields(StudyRow):
            if own.name not in ("refused", "failure"):
                values = [getattr(row, own.name) for row in self.rows]
                columns[own.name] = np.array([np.nan if value is None else value for value in values])
        return columns

    def __len__(self) -> int:
        return len(self.rows)

    def __str__(self) -> str:
        return str(self._found)

    def __repr__(self) -> str:
        return f"StudyReport(duration={self.duration!r}, settings={len(self)})"
