"""Energy of a hot pendulum with schemes that keep the laws and one that does not."""

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
ends = scene.anchor([0, 0]), scene.mass(1.0, [3, 0], [0, 1])
hot = scene.spring(rubber, ends, temperature=380.0)
scene.conduct(hot, scene.reservoir(300.0), 10.0)

drift = {}
for scheme in ("eem-entropy", "eem-temperature", "midpoint"):
    try:
        record = scene.simulate(scheme, step=0.1).run(until=20.0)
    except eem.StepError as error:
        print(f"{scheme}: {error}")
        record = error.record
    drift[scheme] = record.time, record.ledger.energy - record.ledger.energy[0]
    print(f"{scheme:16} {np.abs(drift[scheme][1]).max():.1e} J off until {record.time[-1]:.1f} s")

assert np.abs(drift["eem-entropy"][1]).max() < 1e-9
assert np.abs(drift["eem-temperature"][1]).max() < 1e-9
assert np.abs(drift["midpoint"][1]).max() > 1e-3

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, axes = plt.subplots(layout="constrained")
for scheme, (time, off) in drift.items():
    axes.plot(time, off, label=scheme)
axes.set(xlabel="time (s)", ylabel="energy − energy at the start (J)")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "schemes.png")
