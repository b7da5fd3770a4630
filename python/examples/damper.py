"""A damper is pulled to and fro: its force over its length encloses what it dissipates."""

import sys

import eem
import numpy as np

damper = eem.Material(
    "|x: Stretch, gamma: Viscous, theta: Temperature| {"
    "  0.5 * k * (x - l).powi(2) + 0.5 * mu * (x - l - gamma).powi(2)"
    "  + c * (theta - t0 - theta * ln(theta / t0)) }",
    viscosity={"gamma": "eta * exp(a * (1 / theta - 1 / t0))"},
    k=(20.0, "N/m"), mu=(100.0, "N/m"), l=(1.0, "m"), c=(1.0, "J/K"), t0=(300.0, "K"),
    eta=(10.0, "N s/m"), a=(1000.0, "K"),
)  # fmt: skip

scene = eem.Scene(dim=1)
wall, hand = scene.anchor([0.0]), scene.anchor([1.2])
spring = scene.spring(damper, [wall, hand], temperature=300.0)
scene.move_anchor(hand, lambda t: [1.2 + 0.1 * np.sin(4.0 * t)])
run = scene.simulate("eem-temperature", step=0.01)
record = run.run(until=20.0, forces=True)

ledger = record.ledger
warmer = record.temperature(spring)[-1] - 300.0
print(f"work {ledger.work[-1]:.6f} J, warmer by {warmer:.6f} K, energy off by {np.ptp(ledger.balance):.1e} J")
assert np.ptp(ledger.balance) < 1e-12 and warmer > 0.1
# The area of the loops is the work, to the error of the trapezoidal rule, h²/12 of the second derivative.
area = np.trapezoid(record.force(spring), record.stretch(spring)) if hasattr(np, "trapezoid") else None
assert area is None or abs(area - ledger.work[-1]) < 1e-2

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, axes = plt.subplots(layout="constrained")
axes.plot(record.stretch(spring), record.force(spring), linewidth=0.8)
axes.set(xlabel="length (m)", ylabel="force (N)")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "damper.png")
