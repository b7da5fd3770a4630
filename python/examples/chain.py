"""A chain sags under its weight, and swings when one end is let go."""

import sys

import eem
import numpy as np

COUNT, STIFFNESS, LENGTH = 20, 1e3, 0.1

link = eem.Material(
    "|x: Stretch| 0.5 * k * (x - l).powi(2)", k=(STIFFNESS, "N/m"), l=(LENGTH, "m"), name="link"
)


def chain(ends):
    """A straight chain; the number of its fixed ends is 1 or 2."""
    scene = eem.Scene(dim=2)
    left = scene.anchor([0, 0])
    masses = scene.masses(0.05, [[LENGTH * k, 0.0] for k in range(1, COUNT)])
    right = scene.anchor([LENGTH * COUNT, 0])
    nodes = [left.index, *masses.index] + [right.index] * (ends == 2)
    springs = scene.springs(link, np.column_stack([nodes[:-1], nodes[1:]]))
    scene.set_gravity([0, -10.0])
    return scene, springs


scene, springs = chain(ends=2)
report = scene.equilibrium()
run = scene.simulate("eem-temperature", step=0.01)
rest = run.q
# Each anchor carries half of 19 weights of 0.5 N.
slope = rest[COUNT - 1] - rest[COUNT]
carried = run.force(springs[-1]) * abs(slope[1]) / np.linalg.norm(slope)
print(f"residual {report['residual']:.1e} N, an anchor carries {carried:.9f} N")
assert abs(carried - 4.75) < 1e-9

free, _ = chain(ends=1)
swing = free.simulate("eem-temperature", step=0.005).run(until=1.0, every=20)
assert np.ptp(swing.ledger.energy) < 1e-11

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    sys.exit()

figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
axes.plot(*rest.T, "k.-", label="at rest")
for q in swing.q:
    axes.plot(*q[:COUNT].T, color="C0", alpha=0.4)
axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "chain.png")
