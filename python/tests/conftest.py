"""The pendulum and the plate of the tests: `reference` runs the same."""

import signal

import eem
import numpy as np
import pytest

# A shell that starts programs in the background lets them ignore Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)

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


METAL = """|e1: StrainTrace, e2: StrainSquare, theta: Temperature| {
    0.5 * lame * e1.powi(2) + mu * e2 - beta * (theta - t0) * e1
        + c * (theta - t0 - theta * ln(theta / t0))
}"""
METAL_VALUES = {
    "lame": (2000.0, "Pa"),
    "mu": (1000.0, "Pa"),
    "beta": (3.0, "Pa/K"),
    "c": (100.0, "J/(K m^3)"),
    "t0": (300.0, "K"),
}


@pytest.fixture(scope="session")
def metal():
    return eem.Material(METAL, **METAL_VALUES)


def grid(cells):
    """Nodes and cells of a box of unit cells, in the order of the library."""
    counts = [n + 1 for n in cells]
    nodes = np.stack(np.meshgrid(*[np.arange(n) for n in reversed(counts)], indexing="ij"), -1).reshape(-1, len(cells))
    nodes = nodes[:, ::-1].astype(float)
    number = np.arange(len(nodes)).reshape(counts[::-1])
    corners = [[0, 0], [0, 1], [1, 1], [1, 0]]
    if len(cells) == 3:
        corners = [[z, *corner] for z in (0, 1) for corner in corners]
    shifted = [number[tuple(slice(k, k + n) for k, n in zip(c, cells[::-1], strict=True))] for c in corners]
    return nodes, np.stack(shifted, -1).reshape(-1, len(corners))


def block(scene, material, cells, *, temperature=None, **options):
    """A box that tumbles, is stretched, and is warmer at the end than at the beginning."""
    nodes, corners = grid(cells)
    velocity = np.zeros_like(nodes)
    velocity[:, 0] = 0.25 * nodes[:, 0] - 2.0 * nodes[:, 1]
    velocity[:, 1] = 2.0 * nodes[:, 0]
    if temperature is None:
        temperature = 300.0 + np.arange(corners.size)
    return scene.solid(material, nodes, corners, density=10.0, velocity=velocity, temperature=temperature, **options)


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
