"""The pendulum of the tests: `springs/src/bin/reference.rs` runs the same."""

import eem
import pytest

PSI = """|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let e = ln(lambda / l);
    0.5 * k * e.powi(2) + 0.5 * k1 * (e - gamma / l).powi(2) - beta * (theta - t0) * e
        + c * (theta - t0 - theta * ln(theta / t0))
}"""
VALUES = {
    "l": (1.0, "m"),
    "k": (100.0, "J"),
    "k1": (20.0, "J"),
    "beta": (4.0, "J/K"),
    "c": (1.0, "J/K"),
    "t0": (300.0, "K"),
    "eta": (5.0, "N s/m"),
    "a": (10.0, "K"),
}


@pytest.fixture(scope="session")
def rubber():
    return eem.Material(PSI, viscosity={"gamma": "eta * exp(a / theta)"}, **VALUES)


@pytest.fixture(scope="session")
def hooke():
    return eem.Material("|x: Stretch| 0.5 * k * (x - l).powi(2)", k=4.0, l=1.0)


class Pendulum:
    def __init__(self, rubber):
        self.scene = eem.Scene(dim=2)
        self.pivot = self.scene.anchor([0, 0])
        self.bob = self.scene.mass(1.0, [3, 0], momentum=[0, 1])
        self.spring = self.scene.spring(rubber, [self.pivot, self.bob], temperature=380.0)
        self.air = self.scene.reservoir(300.0)
        self.path = self.scene.conduct(self.spring, self.air, 10.0)


@pytest.fixture
def pendulum(rubber):
    return Pendulum(rubber)


@pytest.fixture
def oscillator(hooke):
    """A mass on a spring, ω = 2/s, with its scene and its spring."""
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.1])
    spring = scene.spring(hooke, [scene.anchor([0.0]), mass])
    return scene, mass, spring
