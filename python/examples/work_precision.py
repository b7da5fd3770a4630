"""What schemes cost for a hot pendulum, and how accurate they are."""

import sys

import eem

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

steps = [0.04 / 2**k for k in range(4)]
schemes = {name: {"steps": steps} for name in ("eem-temperature", "eem-entropy-4", "gauss-4")}
schemes["eem-explicit"] = {"tolerances": [1e-2, 1e-3, 1e-4, 1e-5]}
report = scene.study(2.0, schemes, accuracies=[1e-3, 1e-5], repeats=1)
print(report)

assert abs(report.order("eem-temperature", "p") - 2.0) < 0.2
assert abs(report.order("gauss-4", "p") - 4.0) < 0.2
best = report.recommend(1e-3).lawful
assert best is not None and best.energy_defect < 1e-12

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, axes = plt.subplots(layout="constrained")
for scheme in schemes:
    rows = [row for row in report.rows if row.scheme == scheme and row.largest_error is not None]
    axes.loglog([row.evaluations for row in rows], [row.largest_error for row in rows], "o-", label=scheme)
axes.set(xlabel="evaluations of the force", ylabel="largest relative error after 2 s")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "work_precision.png")
