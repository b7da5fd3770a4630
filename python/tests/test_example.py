"""The example of the README, and what its numbers have to be."""

import eem
import numpy as np


def test_the_fifteen_lines():
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
    x, y = record.time, record.temperature(spring)
    assert x.shape == y.shape == (401,)

    energy = record.ledger.energy
    # Each step is off by no more than its bound, and so is their sum.
    assert np.abs(energy - energy[0]).max() <= record.certificate.bound.sum()
    assert record.certificate.bound.sum() < 1e-8 * abs(energy[0])
    assert np.all(np.abs(record.certificate.defect) <= record.certificate.bound)
    assert record.ledger.entropy[-1] > record.ledger.entropy[0]
    # After ten time constants c/κ the spring is as warm as the air, but for the effect of its vibration.
    assert abs(y[-1] - 300.0) < 5.0


def test_a_mass_on_a_spring_vibrates(oscillator):
    scene, mass, _ = oscillator
    record = scene.simulate("eem-entropy-6", step=0.05).run(until=5.0)
    exact = 1.0 + 0.1 * np.cos(2.0 * record.time)
    # Order 6, (ωh)⁶ = 1e-6 per period and less.
    assert np.abs(record.position(mass)[:, 0] - exact).max() < 1e-8


def test_auto_keeps_a_tolerance(oscillator):
    scene, mass, _ = oscillator
    run = scene.simulate("auto", step=0.1, tolerance=1e-6)
    record = run.run(until=5.0)
    assert abs(record.position(mass)[-1, 0] - (1.0 + 0.1 * np.cos(10.0))) < 1e-5
    assert run.scheme == "auto" and run.scheme_in_use == "eem-explicit"
    assert run.step_statistics["accepted"] == len(record.certificate)
    assert record.scheme == "auto"
