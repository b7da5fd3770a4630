"""Springs, dampers and masses that move and heat up.

A material is a Helmholtz free energy, written as text. Every step conserves energy and momentum to rounding and destroys
no entropy, and says how close it was.

>>> import eem
>>> hooke = eem.Material("|x: Stretch| 0.5 * k * (x - l).powi(2)", k=(100.0, "N/m"), l=(1.0, "m"))
>>> scene = eem.Scene(dim=2)
>>> pivot, bob = scene.anchor([0, 0]), scene.mass(1.0, [1.5, 0], momentum=[0, 2])
>>> spring = scene.spring(hooke, [pivot, bob])
>>> record = scene.simulate("eem-temperature", step=0.01).run(until=5.0)
>>> record.q.shape
(501, 2, 2)
>>> bool(abs(record.ledger.energy - 14.5).max() < 1e-12)
True
"""

from eem._eem import (
    Element,
    ElementArray,
    HeatPath,
    HeatPathArray,
    Material,
    Node,
    NodeArray,
    Reservoir,
    ReservoirArray,
    Scene,
    Simulation,
    StepReport,
    VERSION as __version__,
)
from eem._errors import (
    CheckpointError,
    EemError,
    EquilibriumError,
    Fault,
    GradientError,
    MaterialError,
    SceneError,
    StepError,
)
from eem._formulas import Argument, Formula
from eem._gradient import Gradient, Objective
from eem._record import EnsembleRecord, Record
from eem._sensitivities import Input, Sensitivities
from eem._solid import Solid
from eem._study import Recommendation, StudyReport, StudyRow

__all__ = [
    "Argument",
    "CheckpointError",
    "EemError",
    "Element",
    "ElementArray",
    "EnsembleRecord",
    "EquilibriumError",
    "Fault",
    "Formula",
    "Gradient",
    "GradientError",
    "HeatPath",
    "HeatPathArray",
    "Input",
    "Material",
    "MaterialError",
    "Node",
    "NodeArray",
    "Objective",
    "Recommendation",
    "Record",
    "Reservoir",
    "ReservoirArray",
    "Scene",
    "SceneError",
    "Sensitivities",
    "Simulation",
    "Solid",
    "StepError",
    "StepReport",
    "StudyReport",
    "StudyRow",
    "__version__",
]
