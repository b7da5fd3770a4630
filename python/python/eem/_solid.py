"""Solids of scenes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from eem._eem import ElementArray, NodeArray


class Solid(NamedTuple):
    """A solid of a scene, made by `Scene.solid`."""

    #: its nodes, in the order of the mesh
    nodes: NodeArray
    #: its integration points cell by cell, each with a temperature of its own: as many in a cell as it has nodes
    points: ElementArray
    #: the nodes of its cells, in numbers of nodes of the scene: ``(cells, 4)`` or ``(cells, 8)``
    cells: NDArray[np.int64]
