"""Stiffness and viscosity of a damper from noisy records of a mass that swings on it: exact gradients, and BFGS in a few lines."""

import sys

import eem
import numpy as np

PSI = "|x: Stretch| 0.5 * k * (x - l).powi(2)"
TRUE, SIGMA = np.array([40.0, 1.5]), 2e-3
times = np.arange(1, 41) * 0.05


def swing(parameters):
    """A run that ends steps at the times, its mass, its material and what was recorded."""
    k, eta = parameters
    damper = eem.Material(PSI, viscosity={"x": "eta"}, k=(k, "N/m"), l=(1.0, "m"), eta=(eta, "N s/m"))
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.2])
    scene.spring(damper, [scene.anchor([0.0]), mass])
    run = scene.simulate("eem-temperature", step=0.01)
    run.keep_history()
    record = run.run(times=times)
    return run, mass, damper, record.position(mass)[:, 0]


records = swing(TRUE)[3] + SIGMA * np.random.default_rng(1).standard_normal(len(times))


def misfit(logarithms):
    """Half the sum of squares of the misfits, and its derivatives by the logarithms of the parameters."""
    parameters = np.exp(logarithms)
    run, mass, damper, _ = swing(parameters)
    gradient = run.gradient(eem.Objective.misfit("position", mass, times=times, data=records, sigma=SIGMA))
    return gradient.value, parameters * [gradient.by_parameter(damper, name) for name in ("k", "eta")]


x = np.log([25.0, 5.0])
value, slope = misfit(x)
inverse, evaluations = np.eye(2) / np.linalg.norm(slope), 1
while evaluations < 60 and np.linalg.norm(slope) > 1e-6:
    step = -inverse @ slope
    step *= min(1.0, 0.5 / np.abs(step).max())
    while True:
        evaluations += 1
        next_value, next_slope = misfit(x + step)
        if next_value <= value + 1e-4 * slope @ step or np.linalg.norm(step) < 1e-12:
            break
        step /= 2.0
    change, curvature = next_slope - slope, (next_slope - slope) @ step
    if curvature > 0.0:
        turn = np.eye(2) - np.outer(step, change) / curvature
        inverse = turn @ inverse @ turn.T + np.outer(step, step) / curvature
    x, value, slope = x + step, next_value, next_slope

found = np.exp(x)
# The inverse of the matrix of second derivatives is the covariance of the logarithms.
error = found * np.sqrt(np.diag(inverse))
print(f"k = {found[0]:.3f} ± {error[0]:.3f} N/m, eta = {found[1]:.4f} ± {error[1]:.4f} N s/m, {evaluations} runs")
assert np.all(np.abs(found - TRUE) < 4.0 * error) and np.all(error < 0.02 * TRUE)
# Of 40 records with two parameters: 19 ± 4.4
assert abs(value - 19.0) < 4.0 * 4.4

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, axes = plt.subplots(layout="constrained")
axes.plot(times, swing(np.exp(np.log([25.0, 5.0])))[3], "--", label="first guess")
axes.plot(times, swing(found)[3], label="found")
axes.plot(times, records, "k.", label="records")
axes.set(xlabel="time (s)", ylabel="position (m)")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "identify.png")
