"""Solids: closed forms, both laws, supports, and what is refused."""

import copy
import pickle

import eem
import numpy as np
import pytest

from conftest import METAL_VALUES, block, grid

LAME, MU, BETA, C, T0 = (METAL_VALUES[name][0] for name in ("lame", "mu", "beta", "c", "t0"))


def test_handles(metal):
    scene = eem.Scene(dim=2)
    scene.anchor([9, 9])
    plate = block(scene, metal, [3, 2])
    assert isinstance(plate, eem.Solid)
    assert plate.nodes.index.tolist() == list(range(1, 13)) and len(plate.points) == 24
    assert plate.cells.shape == (6, 4) and plate.cells[0].tolist() == [1, 2, 6, 5]
    assert repr(scene) == "Scene(dim=2, nodes=13, springs=0, points=24, reservoirs=0, paths=0)"
    assert scene.materials == [metal]
    again = pickle.loads(pickle.dumps((scene, plate)))
    run, other = (s.simulate("eem-temperature", step=0.02) for s in (scene, again[0]))
    run.run(until=0.1)
    other.run(until=0.1)
    assert np.array_equal(run.q, other.q) and run.temperature(plate.points[3]) == other.temperature(again[1].points[3])
    assert np.array_equal(copy.copy(run).q, run.q)


@pytest.mark.parametrize("cells", [[3, 2], [2, 1, 1]], ids=["plane", "space"])
def test_stress_of_a_stretched_block(metal, cells):
    """Twice as long, 10 K warmer: E = diag(3/2, 0, 0), S = (λ tr E − β Δθ) 1 + 2 μ E, σ = F S Fᵀ / det F."""
    dim = len(cells)
    nodes, corners = grid(cells)
    scene = eem.Scene(dim=dim)
    # A solid is not deformed where its mesh is; it gets there in one step of moved nodes.
    body = scene.solid(metal, nodes, corners, density=1.0, temperature=T0)
    scene.fix(body.nodes)
    for node, at in zip(body.nodes, nodes, strict=True):
        scene.move_anchor(node, lambda t, at=at: at * (np.array([1.0 + t] + [1.0] * (dim - 1))))
    run = scene.simulate("eem-temperature", step=1.0)
    run.step()
    theta = run.temperature(body.points[0])
    strain = np.diag([1.5, 0.0, 0.0])
    second = (LAME * 1.5 - BETA * (theta - T0)) * np.eye(3) + 2.0 * MU * strain
    deformation = np.diag([2.0, 1.0, 1.0])
    stress = deformation @ second @ deformation / 2.0
    assert run.strain(body.points[0]) == pytest.approx(strain, abs=1e-13)
    assert run.stress(body.points) == pytest.approx(np.tile(stress, (len(body.points), 1, 1)), abs=1e-9)
    # Δs = β tr E + c ln(θ/θ₀) is zero in an adiabatic step without dissipation: in temperature form to the order of the step.
    assert theta < T0


@pytest.mark.parametrize("cells", [[3, 2], [2, 1, 1]], ids=["plane", "space"])
@pytest.mark.parametrize("scheme", ["eem-temperature", "eem-entropy"])
def test_both_laws(metal, cells, scheme):
    scene = eem.Scene(dim=len(cells))
    body = block(scene, metal, cells, conductivity=5.0)
    record = scene.simulate(scheme, step=0.02).run(until=1.0)
    assert record.q.shape == (51, len(body.nodes), len(cells)) and record.theta.shape == (51, len(body.points))
    assert record.gamma.shape == (51, 0)
    bound = record.certificate.bound.sum()
    assert abs(record.ledger.energy - record.ledger.energy[0]).max() <= bound
    assert (np.diff(record.ledger.entropy) >= -1e-12 * abs(record.ledger.entropy[0])).all()
    assert record.ledger.entropy[-1] > record.ledger.entropy[0]
    momentum, spin = record.ledger.linear_momentum, record.ledger.angular_momentum
    assert abs(momentum - momentum[0]).max() < 1e-12 * abs(spin[0]).max()
    assert abs(spin - spin[0]).max() < 1e-12 * abs(spin[0]).max()
    # Heat flows from warm to cold points.
    assert np.ptp(record.theta[-1]) < np.ptp(record.theta[0])
    # It moves.
    assert abs(record.position(body.nodes[-1])[-1] - record.q[0, -1]).max() > 0.5


def test_a_cantilever_under_gravity(metal):
    scene = eem.Scene(dim=2)
    nodes, cells = grid([8, 1])
    beam = scene.solid(metal, nodes, cells, density=1.0, temperature=T0)
    clamped = [node for node, at in zip(beam.nodes, nodes, strict=True) if at[0] == 0.0]
    scene.fix(clamped)
    scene.set_gravity([0.0, -0.05])
    record = scene.simulate("eem-temperature", step=0.05).run(until=1.0)
    assert np.array_equal(record.position(clamped[0]), np.tile([0.0, 0.0], (21, 1)))
    assert record.position(beam.nodes[-1])[-1, 1] < 1.0 - 1e-3
    assert abs(record.ledger.energy - record.ledger.energy[0]).max() <= record.certificate.bound.sum()


def test_a_spring_on_a_solid(metal, hooke):
    scene = eem.Scene(dim=2)
    body = block(scene, metal, [1, 1], temperature=T0)
    spring = scene.spring(hooke, [scene.anchor([-1.0, 0.0]), body.nodes[0]])
    record = scene.simulate("eem-temperature", step=0.02).run(until=0.2, forces=True)
    assert record.force(spring)[0] == 0.0 and np.isfinite(record.force(spring)).all()
    assert np.isnan(record.force(body.points[0])).all()
    assert abs(record.ledger.energy - record.ledger.energy[0]).max() <= record.certificate.bound.sum()


def test_gradient_of_a_solid(metal):
    def run(lame):
        scene = eem.Scene(dim=2)
        body = block(scene, metal.replace(lame=lame), [2, 1], conductivity=5.0)
        run = scene.simulate("eem-temperature", step=0.02)
        run.keep_history()
        run.run(until=0.2)
        return run.gradient(eem.Objective.at_end("position", body.nodes[-1], component=0)), scene, body

    gradient, scene, body = run(LAME)
    by_lame = gradient.by_parameter(scene.materials[0], "lame")
    h = 1e-3 * LAME
    low, near, far, high = (run(LAME + k * h)[0].value for k in (-2, -1, 1, 2))
    assert by_lame == pytest.approx((8.0 * (far - near) - (high - low)) / (12.0 * h), rel=1e-6)
    assert by_lame == gradient.by_parameter(body.points, "lame").sum()


def test_what_is_refused(metal, hooke):
    scene = eem.Scene(dim=2)
    nodes, cells = grid([1, 1])
    options = {"density": 1.0, "temperature": 300.0}
    before = repr(scene)
    with pytest.raises(eem.MaterialError, match="no solid is of this material"):
        scene.solid(hooke, nodes, cells, density=1.0)
    with pytest.raises(eem.MaterialError, match=r"use Scene\.solid"):
        scene.spring(metal, [scene.anchor([0, 0]), scene.anchor([1, 0])])
    scene = eem.Scene(dim=2)
    with pytest.raises(eem.SceneError, match="inside out"):
        scene.solid(metal, nodes, cells[:, ::-1], **options)
    with pytest.raises(eem.SceneError, match=r"shape \(1, 3\), \(n, 4\) is expected"):
        scene.solid(metal, nodes, cells[:, :3], **options)
    with pytest.raises(eem.SceneError, match=r"cells\[0, 1\] is -1"):
        scene.solid(metal, nodes, [[0, -1, 3, 2]], **options)
    with pytest.raises(TypeError):
        scene.solid(metal, nodes, cells + 0.5, **options)
    with pytest.raises(eem.SceneError):
        scene.solid(metal, nodes, [[0, 1, 9, 2]], **options)
    with pytest.raises(eem.SceneError, match="density"):
        scene.solid(metal, nodes, cells, density=-1.0)
    with pytest.raises(eem.SceneError, match="thickness"):
        scene.solid(metal, nodes, cells, thickness=0.0, **options)
    with pytest.raises(eem.SceneError, match="the temperature has the shape"):
        scene.solid(metal, nodes, cells, density=1.0, temperature=[300.0, 301.0])
    assert repr(scene) == before
    body = scene.solid(metal, nodes, cells, density=1.0)
    with pytest.raises(eem.SceneError, match="temperature"):
        scene.simulate("eem-temperature", step=0.1)
    scene.set_temperature(body.points, 300.0)
    run = scene.simulate("eem-temperature", step=0.1)
    with pytest.raises(eem.SceneError):
        run.stretch(body.points[0])
    with pytest.raises(eem.SceneError, match="two or three dimensions"):
        eem.Scene(dim=1).solid(metal, [[0.0], [1.0]], [[0, 1]], **options)
    with pytest.raises(eem.SceneError, match="in the plane"):
        eem.Scene(dim=3).solid(metal, *grid([1, 1, 1]), thickness=1.0, **options)


ELASTIC = {
    "two strains": "|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + mu * e2",
    "neo-Hooke": "|e1: StrainTrace, j: Dilatation| mu * (e1 - ln_1p(j)) + 0.5 * lame * ln_1p(j).powi(2)",
}


@pytest.mark.parametrize("name", ELASTIC)
def test_elastic_solids(name):
    law = eem.Material(ELASTIC[name], lame=2000.0, mu=1000.0)
    for cells in ([2, 1], [2, 1, 1]):
        scene = eem.Scene(dim=len(cells))
        nodes, corners = grid(cells)
        velocity = np.zeros_like(nodes)
        velocity[:, 0] = 0.5 * nodes[:, 0]
        scene.solid(law, nodes, corners, density=10.0, velocity=velocity)
        record = scene.simulate("eem-temperature", step=0.02).run(until=0.5)
        energy = record.ledger.energy
        assert abs(energy - energy[0]).max() <= record.certificate.bound.sum()
        assert np.ptp(record.ledger.kinetic_energy) > 0.1 * energy[0]
