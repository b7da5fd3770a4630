"""A thousand pendulums whose stiffness and viscosity differ, on all cores."""

import sys

import eem
import numpy as np

rubber = eem.Material(
    "|lambda: Stretch, gamma: Viscous, theta: Temperature| {"
    "  let e = ln(lambda / l);"
    "  0.5 * k * e.powi(2) + 0.5 * k1 * (e - gamma / l).powi(2) - beta * (theta - t0) * e"
    "  + c * (theta - t0 - theta * ln(theta / t0)) }",
    viscosity={"gamma": "eta"},
    l=1.0, k=100.0, k1=20.0, beta=0.4, c=1.0, t0=300.0, eta=5.0,
)  # fmt: skip

scene = eem.Scene(dim=2)
ends = scene.anchor([0, 0]), scene.mass(1.0, [1.5, 0], [0, 1])
spring = scene.spring(rubber, ends, temperature=300.0)

random = np.random.default_rng(1)
vary = {"k": random.normal(100.0, 5.0, 1000), "eta": random.lognormal(1.6, 0.5, 1000)}
found = scene.ensemble({rubber: vary}, "eem-temperature", step=0.02, times=np.linspace(0, 5, 26))
found.raise_first()
warmer = found.temperature(spring) - 300.0
print(f"after 5 s warmer by {warmer[:, -1].mean():.3f} ± {warmer[:, -1].std():.3f} K")
assert found.ok.all() and np.all(np.diff(found.ledger.entropy, axis=1) >= -1e-10)
assert np.ptp(found.ledger.energy, axis=1).max() < 1e-9

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, axes = plt.subplots(layout="constrained")
low, middle, high = np.percentile(warmer, [5, 50, 95], axis=0)
axes.fill_between(found.time, low, high, alpha=0.3, label="5 % to 95 %")
axes.plot(found.time, middle, label="median")
axes.set(xlabel="time (s)", ylabel="warmer by (K)")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "ensemble.png")
