"""What runs are differentiated by, and derivatives along them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from eem._errors import SceneError

if TYPE_CHECKING:
    from typing import TypeAlias

    from numpy.typing import ArrayLike, NDArray

    from eem._eem import Element, ElementArray, HeatPath, Material, Node, Reservoir

    _Floats: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Input:
    """An input of a run, for `Simulation.sensitivities`; its methods make one.

    Those that take a function are a parameter α of a function of time of the scene: `by` is its derivative by α, as a function of
    the time in s.

    >>> import eem
    >>> stone = eem.Scene(dim=2).mass(1.0, [0, 0])
    >>> eem.Input.velocity(stone, 1)
    Input.velocity(Node(0), 1)
    >>> eem.Input.force(stone, lambda t: [t, 0.0]).named("slope", "N/s")
    Input.force(Node(0), <function>).named('slope', 'N/s')
    """

    _kind: str
    _of: Any = None
    _name: str = ""
    _index: int | None = None
    _by: Callable[[float], ArrayLike] | None = None
    _named: tuple[str, str] | None = None

    @classmethod
    def parameter(cls, of: Material | Element | ElementArray | Sequence[Element | int], name: str) -> Input:
        """A parameter of a spring, or one that several springs, or all of a material, have in common."""
        return cls("parameter", tuple(of) if isinstance(of, (list, np.ndarray, Iterator)) else of, name)

    @classmethod
    def mass(cls, node: Node) -> Input:
        """A mass, whose velocity at the start is kept, kg."""
        return cls("mass", node)

    @classmethod
    def gravity(cls, axis: int) -> Input:
        """A component, from 0, of the acceleration of free fall, m/s²."""
        return cls("gravity", None, "", _counted(axis, "the axis"))

    @classmethod
    def conductance(cls, path: HeatPath) -> Input:
        """The conductance of a path of heat, W/K."""
        return cls("conductance", path)

    @classmethod
    def reservoir_temperature(cls, reservoir: Reservoir) -> Input:
        """The temperature of a reservoir, K; of one that is a function of time a number that is added to it."""
        return cls("reservoir_temperature", reservoir)

    @classmethod
    def position(cls, node: Node, axis: int) -> Input:
        """A component, from 0, of the position of a node at the start, m; of an anchor of its place, also while it is moved."""
        return cls("position", node, "", _counted(axis, "the axis"))

    @classmethod
    def velocity(cls, node: Node, axis: int) -> Input:
        """A component, from 0, of the velocity of a node at the start, m/s."""
        return cls("velocity", node, "", _counted(axis, "the axis"))

    @classmethod
    def temperature(cls, spring: Element) -> Input:
        """The temperature of a spring at the start, K."""
        return cls("temperature", spring)

    @classmethod
    def viscous_stretch(cls, spring: Element, dashpot: int = 0) -> Input:
        """The viscous stretch of a dashpot in series at the start, counted from 0, m."""
        return cls("viscous_stretch", spring, "", _counted(dashpot, "the dashpot"))

    @classmethod
    def force(cls, node: Node, by: Callable[[float], ArrayLike]) -> Input:
        """A parameter α of the force on a mass, given ∂f/∂α: ``(dim,)``."""
        return cls("force", node, _by=_function(by))

    @classmethod
    def thrust(cls, node: Node, by: Callable[[float], float], rocket: int = 0) -> Input:
        """A parameter α of the thrust of a rocket of a node, in the order of their creation, given ∂F/∂α."""
        return cls("thrust", node, "", _counted(rocket, "the rocket"), _function(by))

    @classmethod
    def motion(cls, anchor: Node, by: Callable[[float], ArrayLike]) -> Input:
        """A parameter α of the position of a moved anchor, given ∂X/∂α: ``(dim,)``."""
        return cls("motion", anchor, _by=_function(by))

    @classmethod
    def thermostat(cls, spring: Element, by: Callable[[float], float]) -> Input:
        """A parameter α of the temperature of a thermostat, given ∂θ/∂α."""
        return cls("thermostat", spring, _by=_function(by))

    @classmethod
    def oven(cls, reservoir: Reservoir, by: Callable[[float], float]) -> Input:
        """A parameter α of the temperature of a reservoir that is a function of time, given ∂θ/∂α."""
        return cls("oven", reservoir, _by=_function(by))

    def named(self, name: str, unit: str = "") -> Input:
        """The same with a name and a unit for the columns of results; a parameter of a function of time has no unit otherwise."""
        return replace(self, _named=(name, unit))

    @property
    def _given(self) -> tuple[Any, ...]:
        return self._kind, self._of, self._name, self._index or 0, self._by, self._named

    def __repr__(self) -> str:
        values = [] if self._of is None else [repr(self._of)]
        values += [repr(self._name)] if self._name else []
        if self._by is not None:
            values.append("<function>")
        if self._index is not None:
            values.append(repr(self._index))
        named = f".named({self._named[0]!r}, {self._named[1]!r})" if self._named else ""
        return f"Input.{self._kind}({', '.join(values)}){named}"


def _counted(value: int, what: str) -> int:
    if not isinstance(value, (int, np.integer)) or isinstance(value, bool) or value < 0:
        raise SceneError(f"{what} is {value!r}; it is a whole number from 0 on")
    return int(value)


def _function(by: Any) -> Any:
    if not callable(by):
        raise TypeError(f"a function of the time is expected, not {type(by).__name__}")
    return by


class Sensitivities:
    """The derivatives of quantities by inputs at every state of a run.

    There is a column for each quantity, or each component of a vector, and input: first those of the first quantity.
    """

    #: the times of all states, s: ``(n,)``
    time: _Floats
    #: the names of all columns: ``"z by mass of node 0"``, of a vector ``"q_x by mass of node 0"``
    names: list[str]
    #: their units: ``"m/kg"``
    units: list[str]
    #: the inputs
    inputs: tuple[Input, ...]

    def __init__(
        self,
        time: _Floats,
        values: _Floats,
        names: list[str],
        units: list[str],
        quantities: list[tuple[str, int | None]],
        inputs: Sequence[Input],
    ) -> None:
        self.time = time
        self.names = names
        self.units = units
        self.inputs = tuple(inputs)
        self._values = values
        self._quantities = quantities

    def of(self, quantity: str | int, by: Input | int) -> _Floats:
        """The derivatives of a quantity, by its name or number, by an input, or its number: ``(n,)``, of a vector ``(n, dim)``."""
        names = [name for name, _ in self._quantities]
        at = _place(quantity, names, f"quantity {quantity!r}: there are {', '.join(names)}")
        column = _place(by, self.inputs, f"input {by!r}: there are {', '.join(map(repr, self.inputs))}")
        first = sum(components or 1 for _, components in self._quantities[:at])
        components = self._quantities[at][1]
        rows = self._values[first * len(self.inputs) + column :: len(self.inputs)]
        return rows[0].copy() if components is None else rows[:components].T.copy()

    def to_dict(self) -> dict[str, _Floats]:
        """Columns by name, for tables: ``time``, and those of `names`."""
        columns = {"time": self.time.copy(), **dict(zip(self.names, self._values.copy(), strict=True))}
        if len(columns) <= len(self.names):
            twice = next(name for name in self.names if name == "time" or self.names.count(name) > 1)
            raise SceneError(f"two columns have the name {twice!r}: give quantities other names, or inputs with `named`")
        return columns

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        quantities = [name for name, _ in self._quantities]
        return f"Sensitivities({quantities}, inputs={len(self.inputs)}, states={len(self)})"


def _place(one: Any, known: Sequence[Any], missing: str) -> int:
    """Where something is among those that there are, or its number."""
    # Handles and truth values are no numbers of columns.
    if isinstance(one, (int, np.integer)) and not isinstance(one, bool):
        if -len(known) <= one < len(known):
            return int(one) % len(known)
    elif one in known:
        return known.index(one)
    raise SceneError(f"there is no {missing}")
