"""Derivatives along runs, and checks of gradients: closed forms, gradients of the same runs, and what is refused."""

import itertools
import pickle
import types

import eem
import numpy as np
import pytest

from conftest import block
from test_gradients import Pair


def test_closed_forms_of_a_thrown_stone():
    scene = eem.Scene(dim=2)
    stone = scene.mass(2.0, [0.0, 1.0], [3.0, 4.0])
    scene.set_gravity([0.0, -9.81])
    scene.force(stone, lambda t: [4.0 * t, 0.0])
    run = scene.simulate("eem-temperature", step=0.01)
    run.keep_history()
    record = run.run(until=1.0)
    slope = eem.Input.force(stone, lambda t: [t, 0.0]).named("a", "N/s")
    inputs = [eem.Input.mass(stone), slope, eem.Input.velocity(stone, 1), eem.Input.position(stone, 0), eem.Input.gravity(1)]
    found = run.sensitivities(inputs, {"q": ("position", stone), "E": "kinetic_energy"})
    t = found.time
    assert np.array_equal(t, record.time) and len(found) == 101
    zero, one = np.zeros_like(t), np.ones_like(t)
    # q = q0 + v t + g t²/2 + (a t³/6m, 0), T = m v²/2 with v = v0 + g t + (a t²/2m, 0); the middle of a step instead of the
    # integral of the force over it has an error of h²/24.
    exact = [[-(t**3) / 6.0, zero], [t**3 / 12.0, zero], [zero, t], [one, zero], [zero, t**2 / 2.0]]
    for given, expected in zip(inputs, exact, strict=True):
        by = found.of("q", given)
        assert by.shape == (101, 2)
        assert by == pytest.approx(np.array(expected).T, abs=1e-5)
    # All of these are linear or quadratic in time, so that the steps are exact to rounding.
    assert found.of("q", 2) == pytest.approx(np.array([zero, t]).T, abs=1e-14)
    assert found.of("q", -1) == pytest.approx(np.array([zero, t**2 / 2.0]).T, abs=1e-13)
    assert found.of("E", inputs[2]) == pytest.approx(2.0 * (4.0 - 9.81 * t), abs=1e-12)
    assert found.of(1, slope) == pytest.approx(2.0 * (3.0 + t**2) * t**2 / 4.0, abs=1e-4)

    assert found.names[:4] == ["q_x by mass of node 0", "q_x by a", "q_x by velocity y of node 0", "q_x by position x of node 0"]
    assert found.units[:4] == ["m/kg", "m/(N/s)", "m/(m/s)", "1"] and found.units[-1] == "J/(m/s²)"
    table = found.to_dict()
    assert list(table) == ["time", *found.names]
    assert np.array_equal(table["q_y by gravity y"], found.of("q", 4)[:, 1])
    assert repr(found) == "Sensitivities(['q', 'E'], inputs=5, states=101)"
    assert repr(inputs[2]) == "Input.velocity(Node(0), 1)"
    assert repr(slope) == "Input.force(Node(0), <function>).named('a', 'N/s')"


def test_closed_form_of_a_mass_on_a_spring(oscillator):
    scene, mass, spring = oscillator
    run = scene.simulate("eem-entropy", step=1e-3)
    run.keep_history()
    run.run(until=1.0)
    k, length = (eem.Input.parameter(spring, name) for name in ("k", "l"))
    found = run.sensitivities(iter([k, length]), {"x": ("position", mass), "l": ("stretch", spring)})
    t = found.time
    # x = l + 0.1 cos ωt with ω² = k/m = 4/s², and 0.1 is 1.1 m - l
    by_k = -0.1 * np.sin(2.0 * t) * t / 4.0
    assert found.of("x", k) == pytest.approx(by_k[:, None], abs=1e-6)
    assert found.of("l", k) == pytest.approx(by_k, abs=1e-6)
    assert found.of("x", length)[:, 0] == pytest.approx(1.0 - np.cos(2.0 * t), abs=1e-5)
    assert found.of("l", eem.Input.parameter(spring, "k")).shape == (1001,)


@pytest.mark.parametrize("scheme", ["eem-temperature", "eem-entropy"])
@pytest.mark.parametrize("snapshots", [None, 5])
def test_all_inputs_agree_with_gradients(scheme, snapshots):
    pair = Pair({})
    run = pair.scene.simulate(scheme, step=0.02)
    run.keep_history(snapshots=snapshots)
    run.run(until=0.6)
    mass, spring = pair.masses[0], pair.springs[1]
    objective = eem.Objective.at_end("position", mass, component=1)
    gradient = run.gradient(objective)
    times, by_force = gradient.by_force(pair.masses[1])
    names = ("l", "k", "k1", "beta", "c", "t0", "eta", "a")
    expected = {
        **{eem.Input.parameter(spring, name): gradient.by_parameter(spring, name) for name in names},
        eem.Input.parameter(pair.rubber, "k"): gradient.by_parameter(pair.rubber, "k"),
        eem.Input.mass(mass): gradient.by_mass(mass),
        eem.Input.gravity(0): gradient.by_gravity()[0],
        eem.Input.conductance(pair.path): gradient.by_conductance(pair.path),
        eem.Input.reservoir_temperature(pair.air): gradient.by_reservoir_temperature(pair.air),
        eem.Input.position(pair.pivot, 1): gradient.by_position(pair.pivot)[1],
        eem.Input.velocity(mass, 1): gradient.by_velocity(mass)[1],
        eem.Input.temperature(spring): gradient.by_temperature(spring),
        eem.Input.viscous_stretch(spring): gradient.by_viscous_stretch(spring),
        eem.Input.force(pair.masses[1], lambda t: [np.cos(t), 0.0]): by_force[:, 0] @ np.cos(times),
    }
    found = run.sensitivities(list(expected), {"q": ("position", mass)})
    size = max(map(abs, expected.values()))
    for given, by in expected.items():
        # Small derivatives are sums of terms of the size of the largest: 8 roundings of it.
        assert abs(found.of("q", given)[-1, 1] - by) <= max(1e-12 * abs(by), 8 * np.finfo(float).eps * size), given
    several = [eem.Input.parameter(of, "k") for of in (pair.springs, [pair.springs[0], 1], pair.rubber)]
    same = run.sensitivities(several, {"E": "energy"})
    assert np.array_equal(same.of("E", 0), same.of("E", 1)) and np.array_equal(same.of("E", 0), same.of("E", 2))
    assert same.units == ["1", "1", "1"] and same.names[0] == "E by k of element 0 (Law) and 1 others"
    with pytest.raises(eem.SceneError, match="two columns have the name"):
        same.to_dict()
    run.check_gradient(objective + eem.Objective.integral("energy"))


def test_a_solid(metal):
    scene = eem.Scene(dim=2)
    sheet = block(scene, metal, [3, 1])
    run = scene.simulate("eem-temperature", step=0.01)
    run.keep_history()
    run.run(until=0.1)
    warm = eem.Objective.at_end("temperature", sheet.points[0])
    run.check_gradient(warm)
    gradient = run.gradient(warm)
    mu, start = eem.Input.parameter(metal, "mu"), eem.Input.temperature(sheet.points[1])
    found = run.sensitivities([mu, start], {"t": ("temperature", sheet.points[0])})
    assert found.of("t", mu)[-1] == pytest.approx(gradient.by_parameter(metal, "mu"), rel=1e-12)
    assert found.of("t", start)[-1] == pytest.approx(gradient.by_temperature(sheet.points[1]), rel=1e-12)
    assert found.units == ["K/Pa", "1"]


def test_functions_of_time(rubber):
    scene = eem.Scene(dim=2)
    anchor, mass = scene.anchor([0.0, 0.0]), scene.mass(1.0, [1.2, 0.0])
    spring, held = scene.springs(rubber, [[anchor, mass]] * 2, temperature=[340.0, 310.0])
    oven = scene.reservoir(lambda t: 300.0 + 5.0 * t)
    scene.conduct(spring, oven, 3.0)
    scene.hold_temperature(held, lambda t: 310.0 + 2.0 * t)
    scene.move_anchor(anchor, lambda t: [0.0, 0.1 * t**2])
    scene.rocket(mass, anchor, mass, lambda t: 2.0 * t)
    run = scene.simulate("eem-temperature", step=0.02)
    run.keep_history()
    run.run(until=0.4)
    gradient = run.gradient(eem.Objective.at_end("temperature", spring))
    of_motion, of_held = gradient.by_motion(anchor), gradient.by_thermostat(held)
    of_thrust, of_oven = gradient.by_thrust(mass), gradient.by_oven(oven)
    expected = {
        eem.Input.motion(anchor, lambda t: [0.0, t**2]): of_motion[1][:, 1] @ of_motion[0] ** 2,
        eem.Input.thermostat(held, lambda t: t): of_held[1] @ of_held[0],
        eem.Input.thrust(mass, lambda t: t): of_thrust[1] @ of_thrust[0],
        eem.Input.oven(oven, lambda t: t): of_oven[1] @ of_oven[0],
    }
    found = run.sensitivities(list(expected), {"theta": ("temperature", spring)})
    for given, by in expected.items():
        assert found.of("theta", given)[-1] == pytest.approx(by, rel=1e-10), given
    run.check_gradient(eem.Objective.at_end("temperature", spring))
    # A parameter of a function has no unit unless it is given one.
    assert found.units == [""] * 4


@pytest.mark.parametrize("kind", ["force", "oven"])
def test_a_function_that_raises_leaves_everything(kind, rubber):
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.1])
    spring = scene.spring(rubber, [scene.anchor([0.0]), mass], temperature=310.0)
    air = scene.reservoir(lambda t: 300.0)
    scene.conduct(spring, air, 1.0)
    scene.force(mass, lambda t: [0.0])
    run = scene.simulate("eem-entropy", step=0.1)
    run.keep_history()
    run.run(until=1.0)
    before = run.checkpoint()

    def fails(time):
        if time > 0.5:
            raise KeyError("gone")
        return [1.0] if kind == "force" else 1.0

    wrong = eem.Input.force(mass, fails) if kind == "force" else eem.Input.oven(air, fails)
    with pytest.raises(KeyError, match="gone"):
        run.sensitivities([wrong], {"q": ("position", mass)})
    assert run.checkpoint() == before
    run.check_gradient(eem.Objective.at_end("position", mass))
    assert len(run.sensitivities([eem.Input.mass(mass)], {"q": ("position", mass)})) == 11
    not_a_vector = eem.Input.force(mass, lambda t: 1.0)
    with pytest.raises(TypeError):
        run.sensitivities([not_a_vector], {"q": ("position", mass)})


def test_a_load_of_another_value_in_every_call_disagrees(rubber):
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.1])
    spring = scene.spring(rubber, [scene.anchor([0.0]), mass], temperature=310.0)
    calls = itertools.count()
    scene.conduct(spring, scene.reservoir(lambda t: 300.0 + next(calls)), 1.0)
    run = scene.simulate("eem-temperature", step=0.1)
    run.keep_history()
    run.run(until=1.0)
    with pytest.raises(eem.GradientError, match="with the gradient and by") as caught:
        run.check_gradient(eem.Objective.at_end("temperature", spring))
    assert caught.value.reason == "Disagrees"


def test_what_is_refused(oscillator, hooke):
    scene, mass, spring = oscillator
    q = {"q": ("position", mass)}
    inputs = [eem.Input.mass(mass)]
    run = scene.simulate("eem-temperature", step=0.1)
    run.run(until=0.5)
    for refused in (lambda: run.sensitivities(inputs, q), lambda: run.check_gradient(eem.Objective.at_end(*q["q"]))):
        with pytest.raises(eem.GradientError, match="keep_history") as caught:
            refused()
        assert caught.value.reason == "NoHistory"
    run.keep_history()
    run.run(until=1.0)
    before = run.checkpoint()
    for given, reason in [
        (eem.Input.parameter(spring, "m"), "UnknownParameter"),
        (eem.Input.force(mass, lambda t: [t]), "NoSeries"),
        (eem.Input.gravity(1), "Component"),
        (eem.Input.position(mass, 3), "Component"),
        (eem.Input.viscous_stretch(spring), "Component"),
    ]:
        with pytest.raises(eem.GradientError) as caught:
            run.sensitivities([given], q)
        assert caught.value.reason == reason
    for given, message in [
        (eem.Input.mass(eem.Scene(dim=1).mass(1.0, [0.0])), "another scene"),
        (eem.Input.parameter(hooke.replace(k=1.0), "k"), "no spring of the scene has the material"),
        (eem.Input.parameter([], "k"), "no spring"),
        (eem.Input.temperature(spring), "no temperature"),
    ]:
        with pytest.raises(eem.SceneError, match=message):
            run.sensitivities([given], q)
    for quantities, error, message in [
        ({"q": "position"}, eem.SceneError, "position of what"),
        ({"q": ("force", spring)}, ValueError, "no derivatives of 'force'"),
        ({"q": ("temperature", spring)}, eem.SceneError, "no temperature"),
        ({"q": ("position", spring)}, TypeError, "a node is expected"),
        ({"q": ("position", mass, 1)}, eem.SceneError, "position has no dashpots: leave 1 out"),
        ({"q": ("energy", spring)}, eem.SceneError, r"energy is that of the scene: leave Element\(0\) out"),
        ({"q": 3}, TypeError, "q: a quantity is"),
        ({"q": ()}, TypeError, "q: a quantity is"),
    ]:
        with pytest.raises(error, match=message):
            run.sensitivities(inputs, quantities)
    again = eem.Input.parameter((one for one in [spring]), "k")
    assert np.array_equal(run.sensitivities([again], q).of("q", again), run.sensitivities([again], q).of("q", again))
    found = run.sensitivities(inputs, types.MappingProxyType(q))
    assert np.array_equal(found.of("q", inputs[0]), run.sensitivities(inputs, q).of("q", inputs[0]))
    with pytest.raises(TypeError, match="an eem.Input is expected, not int"):
        run.sensitivities([3], q)
    for axis in [-1, mass, True]:
        with pytest.raises(eem.SceneError, match="whole number from 0"):
            eem.Input.gravity(axis)
    with pytest.raises(TypeError, match="a function of the time"):
        eem.Input.force(mass, 3.0)
    assert run.checkpoint() == before
    found = run.sensitivities(inputs, q)
    # A handle is not the number of a column.
    for quantity, by in [("p", 0), (1, 0), ("q", 1), ("q", eem.Input.gravity(0)), ("q", mass), ("q", False)]:
        with pytest.raises(eem.SceneError, match="there is no"):
            found.of(quantity, by)
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.of("q", inputs[0]), found.of("q", 0))
    other = scene.simulate("midpoint", step=0.1)
    other.keep_history()
    other.run(until=0.5)
    with pytest.raises(eem.GradientError, match="has no adjoint"):
        other.sensitivities(inputs, q)
