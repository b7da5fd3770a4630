"""What is differentiated, and its derivatives."""

from __future__ import annotations

import html
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from eem._eem import QUANTITIES
from eem._errors import GradientError, SceneError

if TYPE_CHECKING:
    from typing import TypeAlias

    from numpy.typing import ArrayLike, NDArray

    from eem._eem import (
        Element,
        ElementArray,
        HeatPath,
        HeatPathArray,
        Lineage,
        Material,
        Node,
        NodeArray,
        Reservoir,
        ReservoirArray,
    )

    _Floats: TypeAlias = NDArray[np.float64]
    _Nodes: TypeAlias = Node | NodeArray | Sequence[Node | int]
    _Elements: TypeAlias = Element | ElementArray | Sequence[Element | int]
    _Reservoirs: TypeAlias = Reservoir | ReservoirArray | Sequence[Reservoir | int]
    _Paths: TypeAlias = HeatPath | HeatPathArray | Sequence[HeatPath | int]
    _Handle: TypeAlias = Node | Element | Reservoir | None

_VECTORS = ("position", "velocity", "momentum")


class _Term(NamedTuple):
    factor: float
    quantity: str
    of: _Handle
    component: int | None
    dashpot: int
    when: str
    #: times, data and standard deviations
    records: _Floats
    #: the number of components, if there are data of all
    axes: int | None = None


def _not_finite(records: _Floats) -> str:
    """The first number that is not."""
    row, column = np.argwhere(~np.isfinite(records))[0]
    return f"{('the time', 'data', 'sigma')[column]} {row} is {records[row, column]}"


def _term(
    quantity: str,
    of: _Handle,
    component: int | None,
    dashpot: int,
    when: str,
    records: _Floats | None = None,
    axes: int | None = None,
) -> _Term:
    if quantity not in QUANTITIES:
        raise SceneError(f"there are no derivatives of {quantity!r}: take one of {', '.join(QUANTITIES)}")
    records = np.empty((0, 3)) if records is None else records
    if not np.isfinite(records).all():
        raise SceneError(f"{_not_finite(records)}, it must be finite")
    return _Term(1.0, quantity, of, component, dashpot, when, records, axes)


class Objective:
    """A number that follows from the states of a run, for `Simulation.gradient`.

    Quantities are ``"position"``, ``"velocity"`` and ``"momentum"`` of a node, ``"stretch"``, ``"temperature"`` and
    ``"viscous_stretch"`` of a spring, ``"reservoir_entropy"`` and ``"reservoir_heat"`` of a reservoir, and ``"kinetic_energy"`` and
    ``"energy"``. Objectives are added, subtracted, and multiplied by numbers.

    >>> import eem
    >>> scene = eem.Scene(dim=2)
    >>> stone = scene.mass(1.0, [0.0, 0.0], [3.0, 4.0])
    >>> height = eem.Objective.at_end("position", stone, component=1)
    >>> 2.0 * height + eem.Objective.integral("kinetic_energy")
    Objective(2.0 * at_end('position', Node(0), component=1) + integral('kinetic_energy'))
    """

    _terms: tuple[_Term, ...]

    def __init__(self) -> None:
        """Zero; use `at_end`, `at`, `integral` and `misfit`."""
        self._terms = ()

    @classmethod
    def _of(cls, terms: Sequence[_Term]) -> Objective:
        made = cls()
        made._terms = tuple(terms)
        return made

    @classmethod
    def at_end(
        cls, quantity: str, of: _Handle = None, *, component: int | None = None, dashpot: int = 0
    ) -> Objective:
        """A quantity at the end of the run."""
        return cls._of([_term(quantity, of, component, dashpot, "end")])

    @classmethod
    def at(
        cls,
        time: float,
        quantity: str,
        of: _Handle = None,
        *,
        component: int | None = None,
        dashpot: int = 0,
    ) -> Objective:
        """A quantity at a time at which a step ends, s; `run(times=...)` makes steps end at given times."""
        records = np.array([[time, 0.0, 1.0]])
        return cls._of([_term(quantity, of, component, dashpot, "at", records)])

    @classmethod
    def integral(
        cls, quantity: str, of: _Handle = None, *, component: int | None = None, dashpot: int = 0
    ) -> Objective:
        """The integral of a quantity over the time of the history, by the trapezoidal rule over its steps."""
        return cls._of([_term(quantity, of, component, dashpot, "integral")])

    @classmethod
    def misfit(
        cls,
        quantity: str,
        of: _Handle = None,
        *,
        times: ArrayLike,
        data: ArrayLike,
        sigma: ArrayLike = 1.0,
        component: int | None = None,
        dashpot: int = 0,
    ) -> Objective:
        """Half the sum of the squares of (quantity - data) / sigma at times at which steps end, s.

        Data have the shape (times,), or (times, dim) for all components of a vector.
        """
        instants = np.asarray(times, dtype=np.float64)
        if instants.ndim != 1:
            raise SceneError(f"times have {instants.ndim} axes, a list is expected")
        values = np.asarray(data, dtype=np.float64)
        columns = values[:, None] if values.ndim == 1 else values
        if columns.ndim != 2 or len(columns) != len(instants) or columns.shape[1] == 0:
            raise SceneError(f"data of the shape {values.shape} do not fit {len(instants)} times")
        components: list[int | None] = [component]
        if values.ndim == 2:
            if component is not None or quantity not in _VECTORS:
                raise SceneError("data of all components are given: they are for vectors, and without component=")
            components = list(range(columns.shape[1]))
        deviations = np.asarray(sigma, dtype=np.float64)
        if deviations.ndim == 1 and values.ndim == 2:
            deviations = deviations[:, None]
        try:
            deviations = np.broadcast_to(deviations if deviations.ndim != 1 else deviations[:, None], columns.shape)
        except ValueError:
            message = f"sigma of the shape {np.shape(sigma)} does not fit data of the shape {values.shape}"
            raise SceneError(message) from None
        axes = columns.shape[1] if values.ndim == 2 else None
        records = [np.stack([instants, columns[:, k], deviations[:, k]], 1) for k in range(columns.shape[1])]
        return cls._of(
            [
                _term(quantity, of, one, dashpot, "misfit", own, axes)
                for one, own in zip(components, records, strict=True)
            ]
        )

    def __mul__(self, factor: float) -> Objective:
        return self._of([term._replace(factor=term.factor * float(factor)) for term in self._terms])

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Objective:
        return self * (1.0 / float(divisor))

    def __neg__(self) -> Objective:
        return self * -1.0

    def __add__(self, other: Objective) -> Objective:
        if not isinstance(other, Objective):
            return NotImplemented
        return self._of(self._terms + other._terms)

    def __radd__(self, other: int) -> Objective:
        """For `sum`, which begins with 0."""
        return self if other == 0 else NotImplemented

    def __sub__(self, other: Objective) -> Objective:
        if not isinstance(other, Objective):
            return NotImplemented
        return self + -other

    def __repr__(self) -> str:
        shown = []
        for term in self._terms:
            values = [repr(term.quantity)]
            if term.when == "at":
                values.insert(0, repr(float(term.records[0, 0])))
            if term.of is not None:
                values.append(repr(term.of))
            if term.when == "misfit":
                values.append(f"<{len(term.records)} records>")
            if term.component is not None:
                values.append(f"component={term.component}")
            if term.quantity == "viscous_stretch":
                values.append(f"dashpot={term.dashpot}")
            name = "at_end" if term.when == "end" else term.when
            factor = "" if term.factor == 1.0 else f"{term.factor!r} * "
            shown.append(f"{factor}{name}({', '.join(values)})")
        return f"Objective({' + '.join(shown)})"


class Gradient:
    """The value of an objective, and its derivatives by all inputs of a run.

    Each has the unit of the objective over that of the input. A method gives the derivative by one node, spring, …, an array for
    several, and an array for all without an argument.
    """

    #: the value of the objective
    value: float
    #: how much more a relative change of an earlier state does than one of the state at the end; errors are some ε times that
    growth: float
    #: a warning if few digits are left
    note: str | None

    def __init__(
        self,
        shown: tuple[float, float, str | None, str | None],
        arrays: dict[str, _Floats],
        series: dict[tuple[str, int, int], tuple[_Floats, _Floats]],
        lineage: Lineage,
        materials: list[Material],
        laws: NDArray[np.int64],
    ) -> None:
        self.value, self.growth, self.note, self._timed = shown
        self._arrays = arrays
        self._series = series
        self._lineage = lineage
        self._materials = materials
        self._laws = laws
        counts = np.array([len(material.parameters) for material in materials], dtype=np.int64)
        #: where the derivatives by the parameters of each spring begin
        self._first = np.concatenate([[0], np.cumsum(counts[laws])])

    def by_parameter(self, of: Material | _Elements, name: str) -> Any:
        """By a parameter of a spring; an array for several springs, and their sum for a material. Entries of arrays have names like ``"k[0]"``."""
        for index, material in enumerate(self._materials):
            if material is of:
                springs = np.flatnonzero(self._laws == index)
                return float(self._by_parameter(springs, name).sum())
        if type(of).__name__ == "Material":
            raise SceneError(f"no spring of the scene has the material {of!r}")
        springs = self._lineage.elements(of)
        found = self._by_parameter(np.atleast_1d(springs), name)
        return float(found[0]) if np.ndim(springs) == 0 else found

    def _by_parameter(self, springs: NDArray[np.int64], name: str) -> _Floats:
        found = np.empty(len(springs))
        for law in np.unique(self._laws[springs]):
            material = self._materials[law]
            names = list(material.parameters)
            if name not in names:
                raise GradientError(
                    f"`{material.name}` has no parameter `{name}`; it has {', '.join(names)}",
                    reason="UnknownParameter",
                )
            own = self._laws[springs] == law
            found[own] = self._arrays["parameters"][self._first[springs[own]] + names.index(name)]
            if np.isnan(found[own]).any():
                raise GradientError(
                    f"`{material.name}` has {len(names)} parameters: there are derivatives by up to 64, and if their formulas fit",
                    reason="NoParameterDerivatives",
                )
        return found

    def _of_nodes(self, name: str, nodes: _Nodes | None) -> Any:
        values = self._arrays[name]
        return values.copy() if nodes is None else values[self._lineage.nodes(nodes)]

    def by_position(self, nodes: _Nodes | None = None) -> Any:
        """By positions at the start; of anchors by their places: ``(dim,)`` or ``(n, dim)``."""
        return self._of_nodes("position", nodes)

    def by_velocity(self, nodes: _Nodes | None = None) -> Any:
        """By velocities at the start: ``(dim,)`` or ``(n, dim)``."""
        return self._of_nodes("velocity", nodes)

    def by_mass(self, nodes: _Nodes | None = None) -> Any:
        """By masses, with their velocities kept; zero of anchors."""
        return self._of_nodes("mass", nodes)

    def by_temperature(self, springs: _Elements | None = None) -> Any:
        """By temperatures of springs at the start; NaN of those that have none."""
        values = self._arrays["temperature"]
        return values.copy() if springs is None else values[self._lineage.elements(springs)]

    def by_viscous_stretch(self, spring: Element, dashpot: int = 0) -> float:
        """By the viscous stretch of a dashpot in series at the start, counted from 0."""
        index = self._lineage.element(spring)
        counts = [sum(a.role == "Viscous" for a in material.arguments) for material in self._materials]
        of_springs = [counts[law] for law in self._laws]
        if not 0 <= dashpot < of_springs[index]:
            raise SceneError(f"{spring} has no dashpot {dashpot}: it has {of_springs[index]}, counted from 0")
        return float(self._arrays["viscous_stretch"][sum(of_springs[:index]) + dashpot])

    def by_conductance(self, paths: _Paths | None = None) -> Any:
        """By conductances of paths of heat."""
        values = self._arrays["conductance"]
        return values.copy() if paths is None else values[self._lineage.paths(paths)]

    def by_reservoir_temperature(self, reservoirs: _Reservoirs | None = None) -> Any:
        """By temperatures of reservoirs; of one that is a function of time by a number that is added to it."""
        values = self._arrays["reservoir_temperature"]
        return values.copy() if reservoirs is None else values[self._lineage.reservoirs(reservoirs)]

    def by_gravity(self) -> _Floats:
        """By the acceleration of free fall: ``(dim,)``."""
        return self._arrays["gravity"].copy()

    def by_step_size(self, *, kept_loads: bool = False) -> tuple[_Floats, _Floats]:
        """Times at the ends of all steps, and the derivatives by their sizes.

        They need loads that do not depend on time; ``kept_loads`` keeps the values that these had in each step.
        """
        if self._timed is not None and not kept_loads:
            message = self._timed.replace("by_step_size_at_kept_loads", "by_step_size(kept_loads=True)")
            raise GradientError(message, reason="NoTimeDerivative")
        return self._arrays["times"].copy(), self._arrays["step_size"].copy()

    def by_end_time(self) -> float:
        """By the time at the end, by the size of the last step; zero without a step."""
        sizes = self.by_step_size()[1]
        return float(sizes[-1]) if len(sizes) else 0.0

    def by_force(self, node: Node) -> tuple[_Floats, _Floats]:
        """Times in the middle of all steps, and the derivatives by the force on a mass then: ``(steps,)``, ``(steps, dim)``."""
        return self._by_function("force", self._lineage.node(node), f"{node} has no force")

    def by_thrust(self, node: Node, rocket: int = 0) -> tuple[_Floats, _Floats]:
        """The same by the thrust of a rocket of a node, in the order of their creation."""
        index = self._lineage.node(node)
        return self._by_function("thrust", index, f"{node} has no rocket {rocket}", rocket)

    def by_motion(self, anchor: Node) -> tuple[_Floats, _Floats]:
        """Times at the ends of all steps, and the derivatives by the positions of a moved anchor there."""
        return self._by_function("motion", self._lineage.node(anchor), f"{anchor} is not moved")

    def by_thermostat(self, spring: Element) -> tuple[_Floats, _Floats]:
        """Times at the ends of all steps, and the derivatives by the temperatures that a thermostat reaches there."""
        return self._by_function("thermostat", self._lineage.element(spring), f"{spring} has no thermostat")

    def by_oven(self, reservoir: Reservoir) -> tuple[_Floats, _Floats]:
        """Times in the middle of all steps, and the derivatives by the temperature of an oven then."""
        index = int(self._lineage.reservoirs(reservoir))
        return self._by_function("oven", index, f"{reservoir} is not an oven")

    def _by_function(self, of: str, index: int, missing: str, rocket: int = 0) -> tuple[_Floats, _Floats]:
        found = self._series.get((of, index, rocket))
        if found is None:
            raise GradientError(f"{missing}: there are no values to differentiate by", reason="NoSeries")
        times, values = found
        return times.copy(), values.copy()

    def _rows(self) -> list[tuple[str, str, float]]:
        """The derivatives by the parameters of all materials and by gravity, with the values of the inputs."""
        rows = []
        for index, material in enumerate(self._materials):
            springs = np.flatnonzero(self._laws == index)
            for name, value in material.parameters.items():
                by = self._arrays["parameters"][self._first[springs] + list(material.parameters).index(name)]
                rows.append((f"{name} of {material.name}", f"{value!r}", float(by.sum())))
        for axis, by in enumerate(self._arrays["gravity"]):
            rows.append((f"gravity[{axis}]", "", float(by)))
        return rows

    def __str__(self) -> str:
        lines = [f"value {self.value!r}"]
        rows = self._rows()
        width = max((len(name) for name, _, _ in rows), default=0)
        lines += [f"by {name:<{width}} {by: .15e}" for name, _, by in rows]
        return "\n".join(lines + ([self.note] if self.note else []))

    def _repr_html_(self) -> str:
        head = "<tr><th>input</th><th>its value</th><th>derivative</th></tr>"
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{value}</td><td>{by:.8g}</td></tr>" for name, value, by in self._rows()
        )
        note = f"<p>{html.escape(self.note)}</p>" if self.note else ""
        return f"<p>value {self.value!r}</p><table>{head}{rows}</table>{note}"

    def __repr__(self) -> str:
        nodes, springs = len(self._arrays["mass"]), len(self._laws)
        return f"Gradient(value={self.value!r}, growth={self.growth:.3g}, nodes={nodes}, springs={springs})"
