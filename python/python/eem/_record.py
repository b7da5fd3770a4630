"""What runs leave: arrays that own their memory."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from eem._eem import LEDGER

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from eem._eem import Element, Lineage, Node

    _Floats = NDArray[np.float64]

_CERTIFICATE = (
    "time",
    "step",
    "iterations",
    "update",
    "residual",
    "defect",
    "bound",
    "is_bound_wide",
    "production",
    "least_production",
    "error",
    "correction",
)


def as_ledger(rows: _Floats) -> np.recarray[Any, Any]:
    """Rows of numbers as balances with names."""
    dim = rows.shape[-1] - len(LEDGER) - 3
    fields: list[Any] = [(name, np.float64) for name in LEDGER]
    fields += [("linear_momentum", np.float64, (dim,)), ("angular_momentum", np.float64, (3,))]
    return np.ascontiguousarray(rows).view(np.dtype(fields))[..., 0].view(np.recarray)


def _as_certificate(columns: dict[str, NDArray[Any]]) -> np.recarray[Any, Any]:
    fields = [(name, columns[name].dtype) for name in _CERTIFICATE]
    rows = np.empty(len(columns["time"]), np.dtype(fields))
    for name in _CERTIFICATE:
        rows[name] = columns[name]
    return rows.view(np.recarray)


class _Arrays:
    """States at some times. The axis of time is the first one, or the second after that of the members."""

    #: the times, s
    time: _Floats
    #: positions of all nodes, m: ``(..., nodes, dim)``
    q: _Floats
    #: momenta of all nodes, kg m/s: ``(..., nodes, dim)``
    p: _Floats
    #: temperatures of all springs, K, NaN of those that have none: ``(..., springs)``
    theta: _Floats
    #: viscous stretches of all dashpots in series, spring by spring, m: ``(..., dashpots)``
    gamma: _Floats
    #: energies, entropies and momenta, by name
    ledger: np.recarray[Any, Any]
    #: the scheme
    scheme: str

    def __init__(
        self, arrays: dict[str, Any], lineage: Lineage, dashpots: NDArray[np.int64], scheme: str
    ) -> None:
        self.time = arrays["time"]
        self.q = arrays["q"]
        self.p = arrays["p"]
        self.theta = arrays["theta"]
        self.gamma = arrays["gamma"]
        self.ledger = as_ledger(arrays["ledger"])
        self.scheme = scheme
        self._lineage = lineage
        self._dashpots = dashpots

    def position(self, node: Node) -> _Floats:
        """Where a node was, m: ``(..., dim)``."""
        return self.q[..., self._lineage.node(node), :].copy()

    def momentum(self, node: Node) -> _Floats:
        """The momentum of a node, kg m/s: ``(..., dim)``."""
        return self.p[..., self._lineage.node(node), :].copy()

    def temperature(self, spring: Element) -> _Floats:
        """The temperature of a spring, K."""
        values = self.theta[..., self._lineage.element(spring)]
        if values.size and np.isnan(values).all() and not self._has_failed():
            from eem._errors import SceneError

            raise SceneError(f"{spring} has no temperature: its free energy has no `Temperature`")
        return values.copy()

    def viscous_stretch(self, spring: Element, dashpot: int = 0) -> _Floats:
        """The viscous stretch of a dashpot in series, m, counted from 0."""
        index = self._lineage.element(spring)
        count = int(self._dashpots[index])
        if not 0 <= dashpot < count:
            from eem._errors import SceneError

            raise SceneError(f"{spring} has no dashpot {dashpot}: it has {count}, counted from 0")
        return self.gamma[..., int(self._dashpots[:index].sum()) + dashpot].copy()

    def _has_failed(self) -> bool:
        return False


class Record(_Arrays):
    """A run: its states, balances and certificates."""

    #: a row for each step, whether its state was recorded or not: what it proves
    certificate: np.recarray[Any, Any]
    #: ``"reached"``, ``"interrupted"`` by Ctrl-C, or ``"failed"``, in the record of a ``StepError``
    end: str

    def __init__(
        self,
        arrays: dict[str, Any],
        lineage: Lineage,
        dashpots: NDArray[np.int64],
        end: str,
        scheme: str,
    ) -> None:
        super().__init__(arrays, lineage, dashpots, scheme)
        self.certificate = _as_certificate(arrays["certificate"])
        self.end = end
        self._stretches: _Floats | None = arrays.get("stretches")
        self._forces: _Floats | None = arrays.get("forces")

    def stretch(self, spring: Element) -> _Floats:
        """The length of a spring, m, if the run recorded forces."""
        return self._recorded(self._stretches, spring)

    def force(self, spring: Element) -> _Floats:
        """The force of a spring, N, positive in tension, if the run recorded forces."""
        return self._recorded(self._forces, spring)

    def _recorded(self, values: _Floats | None, spring: Element) -> _Floats:
        if values is None:
            from eem._errors import SceneError

            raise SceneError("forces were not recorded: use run(..., forces=True)")
        return values[:, self._lineage.element(spring)].copy()

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """Columns by name, for tables: ``time``, ``q0_0``, …, ``theta0``, …, ``energy``, ``entropy``."""
        columns: dict[str, NDArray[Any]] = {"time": self.time}
        for name, values in (("q", self.q), ("p", self.p)):
            for node, axis in np.ndindex(values.shape[1:]):
                columns[f"{name}{node}_{axis}"] = values[:, node, axis]
        for name, values in (("theta", self.theta), ("gamma", self.gamma)):
            for index in range(values.shape[1]):
                columns[f"{name}{index}"] = values[:, index]
        for entry in LEDGER:
            columns[entry] = self.ledger[entry]
        return columns

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        rows, nodes, dim = self.q.shape
        last = float(self.time[-1]) if rows else float("nan")
        return (
            f"Record({self.scheme!r}, rows={rows}, nodes={nodes}, dim={dim}, "
            f"springs={self.theta.shape[1]}, until={last!r}, end={self.end!r})"
        )


class EnsembleRecord(_Arrays):
    """The states of all members of an ensemble at some times; NaN for members that failed."""

    #: why a member has no states, None for the others
    errors: list[Exception | None]

    def __init__(
        self,
        arrays: dict[str, Any],
        lineage: Lineage,
        dashpots: NDArray[np.int64],
        errors: list[Exception | None],
        scheme: str,
    ) -> None:
        super().__init__(arrays, lineage, dashpots, scheme)
        self.errors = errors

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Whether each member has reached the last time."""
        return np.array([error is None for error in self.errors], dtype=np.bool_)

    def raise_first(self) -> None:
        """Raises the error of the first member that failed."""
        for error in self.errors:
            if error is not None:
                raise error

    def _has_failed(self) -> bool:
        return not self.ok.any()

    def __len__(self) -> int:
        return len(self.errors)

    def __repr__(self) -> str:
        failed = int(np.count_nonzero(~self.ok))
        return f"EnsembleRecord({self.scheme!r}, members={len(self)}, times={len(self.time)}, failed={failed})"
