"""A hot pendulum of rubber cools down in air: energy is conserved, entropy grows."""

import sys

import eem
import numpy as np

rubber = eem.Material(
    "|lambda: Stretch, gamma: Viscous, theta: Temperature| {"
    "  let e = ln(lambda / l);"
    "  0.5 * k * e.powi(2) + 0.5 * k1 * (e - gamma / l).powi(2) - beta * (theta - t0) * e"
    "  + c * (theta - t0 - theta * ln(theta / t0)) }",
    viscosity={"gamma": "eta * exp(a / theta)"},
    l=(1.0, "m"), k=(100.0, "J"), k1=(20.0, "J"), beta=(4.0, "J/K"),
    c=(1.0, "J/K"), t0=(300.0, "K"), eta=(5.0, "N s/m"), a=(10.0, "K"),
)  # fmt: skip

scene = eem.Scene(dim=2)
pivot, bob = scene.anchor([0, 0]), scene.mass(1.0, [3, 0], momentum=[0, 1])
spring = scene.spring(rubber, [pivot, bob], temperature=380.0)
scene.conduct(spring, scene.reservoir(300.0), 10.0)
record = scene.simulate("eem-temperature", step=0.05).run(until=20.0)

energy = record.ledger.energy
print(f"energy  {energy[-1]:.9f} J, {energy[0]:.9f} J at the start")
print(f"entropy {record.ledger.entropy[-1] - record.ledger.entropy[0]:+.6f} J/K")
assert np.abs(energy - energy[0]).max() <= record.certificate.bound.sum()
assert np.all(record.certificate.least_production >= 0)

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, (path, heat) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
path.plot(*record.position(bob).T)
path.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
heat.plot(record.time, record.temperature(spring))
heat.set(xlabel="time (s)", ylabel="temperature (K)")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "pendulum.png")
