"""Gradients of runs: closed forms, differences of runs, and what is refused."""

import math
import pickle
import signal
import threading

import eem
import numpy as np
import pytest

from conftest import PSI, VALUES

# A four-point difference with this relative change has the error h⁴ of a fifth derivative, and rounding over h: that of the heat and
# entropy of bodies at 300 K, some 1e-12 of what they change by in the run.
CHANGE = 1e-3
ALLOWED = 1e-6


def differences(value, at):
    """The derivative of a function by a number."""
    h = CHANGE * (abs(at) or 1.0)
    low, near, far, high = (value(at + k * h) for k in (-2, -1, 1, 2))
    return (8.0 * (far - near) - (high - low)) / (12.0 * h)


def test_closed_form_of_a_mass_on_a_spring(oscillator):
    scene, mass, spring = oscillator
    run = scene.simulate("eem-temperature", step=1e-3)
    run.keep_history()
    run.run(until=1.0)
    gradient = run.gradient(eem.Objective.at_end("position", mass))
    # q = 1 + 0.1 cos(ωt) with ω² = k/m = 4/s²; the step has the error of h².
    assert gradient.value == run.position(mass)[0]
    hooke = scene.materials[0]
    assert gradient.by_parameter(spring, "k") == pytest.approx(-0.1 * math.sin(2.0) / 4.0, abs=1e-7)
    assert gradient.by_parameter(hooke, "k") == gradient.by_parameter(spring, "k")
    assert gradient.by_mass(mass) == pytest.approx(0.1 * math.sin(2.0), abs=1e-6)
    assert gradient.by_position(mass) == pytest.approx([math.cos(2.0)], abs=1e-6)
    assert gradient.by_velocity(mass) == pytest.approx([math.sin(2.0) / 2.0], abs=1e-6)
    assert gradient.by_end_time() == pytest.approx(-0.2 * math.sin(2.0), abs=1e-6)
    times, sizes = gradient.by_step_size()
    assert times.shape == sizes.shape == (1000,) and times[-1] == 1.0
    assert gradient.by_position().shape == (2, 1) and gradient.by_mass().shape == (2,)
    assert gradient.by_gravity().shape == (1,)
    assert gradient.by_gravity()[0] == pytest.approx((1.0 - math.cos(2.0)) / 4.0, abs=1e-6)


class Pair:
    """Two rubber springs, one warmer than the other, with a reservoir and a force."""

    def __init__(self, inputs):
        values = {name: (inputs.get(name, value), unit) for name, (value, unit) in VALUES.items()}
        self.rubber = eem.Material(PSI, viscosity={"gamma": "eta * exp(a / theta)"}, **values)
        self.scene = eem.Scene(dim=2)
        self.scene.set_gravity([0.0, inputs.get("gravity", -2.0)])
        self.pivot = self.scene.anchor([0, 0])
        velocity = [inputs.get("velocity", 0.3), 1.0]
        self.masses = [self.scene.mass(inputs.get("mass", 1.0), [1.2, 0.0], velocity), self.scene.mass(0.5, [2.0, 0.4])]
        pairs = [[self.pivot, self.masses[0]], self.masses]
        temperatures = [inputs.get("temperature", 340.0), 300.0]
        self.springs = self.scene.springs(self.rubber, pairs, temperature=temperatures)
        self.air = self.scene.reservoir(inputs.get("air", 290.0))
        self.path = self.scene.conduct(self.springs[1], self.air, inputs.get("conductance", 3.0))
        self.scene.conduct(self.springs[0], self.springs[1], 2.0)
        push = inputs.get("push", 0.7)
        self.scene.force(self.masses[1], lambda t: [push * np.cos(t), 0.0])

    def run(self, scheme):
        run = self.scene.simulate(scheme, step=0.02)
        run.keep_history()
        run.run(until=0.6)
        objective = (
            2.0 * eem.Objective.at_end("position", self.masses[0], component=1)
            - eem.Objective.integral("temperature", self.springs[0]) / 100.0
            + eem.Objective.at(0.4, "viscous_stretch", self.springs[1])
            + eem.Objective.misfit(
                "velocity", self.masses[1], times=[0.2, 0.6], data=[[0.1, 0.2], [0.3, 0.4]], sigma=[0.5, 2.0]
            )
            + eem.Objective.at_end("kinetic_energy")
            + eem.Objective.at_end("reservoir_heat", self.air)
        )
        return run, objective


@pytest.mark.parametrize("scheme", ["eem-temperature", "eem-entropy"])
def test_differences_of_runs(scheme):
    pair = Pair({})
    run, objective = pair.run(scheme)
    gradient = run.gradient(objective)

    def value(name, at):
        run, objective = Pair({name: at}).run(scheme)
        return run.gradient(objective).value

    times, by_force = gradient.by_force(pair.masses[1])
    found = {
        **{name: gradient.by_parameter(pair.rubber, name) for name in VALUES},
        "mass": gradient.by_mass(pair.masses[0]),
        "velocity": gradient.by_velocity(pair.masses[0])[0],
        "temperature": gradient.by_temperature(pair.springs)[0],
        "air": gradient.by_reservoir_temperature(pair.air),
        "conductance": gradient.by_conductance(pair.path),
        "gravity": gradient.by_gravity()[1],
        # f = push cos(t): the sum of dJ/df cos(t)
        "push": by_force[:, 0] @ np.cos(times),
    }
    inputs = {name: at for name, (at, _) in VALUES.items()}
    inputs |= {"mass": 1.0, "velocity": 0.3, "temperature": 340.0, "air": 290.0}
    inputs |= {"conductance": 3.0, "gravity": -2.0, "push": 0.7}
    for name, at in inputs.items():
        expected = differences(lambda moved, name=name: value(name, moved), at)
        size = max(abs(expected), abs(gradient.value / at))
        assert abs(found[name] - expected) < ALLOWED * size, (name, found[name], expected)


def test_the_parts_of_a_material():
    pair = Pair({})
    run, objective = pair.run("eem-temperature")
    gradient = run.gradient(objective)
    each = gradient.by_parameter(pair.springs, "k")
    assert each.shape == (2,) and each[0] == gradient.by_parameter(pair.springs[0], "k")
    assert gradient.by_parameter(pair.rubber, "k") == each.sum()
    assert gradient.by_position().shape == gradient.by_velocity(pair.scene.nodes).shape == (3, 2)
    assert np.array_equal(gradient.by_mass(pair.masses), gradient.by_mass()[1:])
    assert isinstance(gradient.by_viscous_stretch(pair.springs[1]), float)
    assert "by k of" in str(gradient) and "<table>" in gradient._repr_html_()
    again = pickle.loads(pickle.dumps(gradient))
    assert again.value == gradient.value and np.array_equal(again.by_position(), gradient.by_position())


def test_fewer_states_have_the_same_bits():
    pair = Pair({})
    run, objective = pair.run("eem-entropy")
    all_ = run.gradient(objective)
    again = pair.scene.simulate("eem-entropy", step=0.02)
    again.keep_history(snapshots=5)
    again.run(until=0.6)
    few = again.gradient(objective)
    assert few.value == all_.value
    assert np.array_equal(few.by_position(), all_.by_position())
    assert few.by_parameter(pair.rubber, "eta") == all_.by_parameter(pair.rubber, "eta")


def test_times_are_met_by_steps(oscillator):
    scene, mass, _ = oscillator
    run = scene.simulate("eem-temperature", step=0.1)
    run.keep_history()
    times = [0.123, 0.4, 0.777]
    record = run.run(times=times)
    assert record.time.tolist() == times and record.end == "reached"
    assert len(record.certificate) > 3
    data = record.position(mass)[:, 0]
    gradient = run.gradient(eem.Objective.misfit("position", mass, times=times, data=data))
    assert gradient.value == 0.0 and gradient.by_mass(mass) == 0.0
    data[1] += 0.5
    gradient = run.gradient(eem.Objective.misfit("position", mass, times=times, data=data, sigma=0.5))
    assert gradient.value == 0.5


def test_what_is_refused(oscillator, hooke):
    scene, mass, spring = oscillator
    position = eem.Objective.at_end("position", mass)
    run = scene.simulate("eem-temperature", step=0.1)
    run.run(until=0.5)
    with pytest.raises(eem.GradientError, match="keep_history") as caught:
        run.gradient(position)
    assert caught.value.reason == "NoHistory"
    run.keep_history()
    run.run(until=1.0)
    before = run.checkpoint()
    with pytest.raises(eem.GradientError, match=r"run\(times=...\)") as caught:
        run.gradient(eem.Objective.at(0.77, "position", mass))
    assert caught.value.reason == "NotAnEndOfStep"
    with pytest.raises(eem.GradientError, match="no parameter `m`; it has k, l"):
        run.gradient(position).by_parameter(spring, "m")
    with pytest.raises(eem.GradientError, match="no force"):
        run.gradient(position).by_force(mass)
    with pytest.raises(eem.SceneError, match="another scene"):
        run.gradient(eem.Objective.at_end("position", eem.Scene(dim=1).mass(1.0, [0.0])))
    with pytest.raises(eem.SceneError, match="position of what"):
        run.gradient(eem.Objective.at_end("position"))
    with pytest.raises(eem.SceneError, match="material"):
        run.gradient(position).by_parameter(hooke.replace(k=1.0), "k")
    with pytest.raises(ValueError, match="no derivatives of 'force'"):
        eem.Objective.at_end("force", spring)
    with pytest.raises(eem.SceneError, match="no temperature"):
        run.gradient(eem.Objective.at_end("temperature", spring))
    with pytest.raises(eem.GradientError, match="standard deviation"):
        run.gradient(eem.Objective.misfit("position", mass, times=[1.0], data=[0.0], sigma=0.0))
    with pytest.raises(eem.SceneError, match=r"sigma of the shape \(2,\) does not fit"):
        eem.Objective.misfit("position", mass, times=[0.5, 1.0, 1.5], data=[0.0] * 3, sigma=[1.0, 2.0])
    with pytest.raises(eem.SceneError, match="do not fit"):
        eem.Objective.misfit("position", mass, times=[1.0], data=[0.0, 1.0])
    with pytest.raises(eem.SceneError, match="do not fit"):
        eem.Objective.misfit("position", mass, times=[1.0], data=np.zeros((1, 0)))
    with pytest.raises(eem.SceneError, match="data of position have 2 components, it has 1"):
        run.gradient(eem.Objective.misfit("position", mass, times=[1.0], data=[[0.0, 1.0]]))
    with pytest.raises(eem.SceneError, match="sigma 0 is nan, it must be finite"):
        eem.Objective.misfit("position", mass, times=[1.0], data=[0.0], sigma=math.nan)
    with pytest.raises(eem.SceneError, match="the time 0 is inf, it must be finite"):
        eem.Objective.at(math.inf, "position", mass)
    with pytest.raises(eem.SceneError, match="stretch has no dashpots"):
        run.gradient(eem.Objective.at_end("stretch", spring, dashpot=1))
    with pytest.raises(eem.SceneError, match="kinetic_energy is that of the scene"):
        run.gradient(eem.Objective.integral("kinetic_energy", mass))
    with pytest.raises(TypeError, match="an eem.Objective is expected, not NoneType"):
        run.gradient(None)
    assert run.checkpoint() == before
    flat = eem.Scene(dim=2)
    stone = flat.mass(1.0, [0, 0])
    run = flat.simulate("eem-temperature", step=0.1)
    run.keep_history()
    with pytest.raises(eem.SceneError, match="position has 2 components"):
        run.gradient(eem.Objective.at_end("position", stone))
    other = scene.simulate("midpoint", step=0.1)
    other.keep_history()
    other.run(until=0.5)
    with pytest.raises(eem.GradientError, match="has no adjoint"):
        other.gradient(position)


def test_laws_with_many_parameters(oscillator):
    terms = " + ".join(f"k{n} * (x - 1).powi(2)" for n in range(65))
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.1])
    law = eem.Material(f"|x: Stretch| {terms}", **{f"k{n}": 0.1 for n in range(65)})
    spring = scene.spring(law, [scene.anchor([0.0]), mass])
    run = scene.simulate("eem-temperature", step=0.1)
    run.keep_history()
    run.run(until=0.5)
    gradient = run.gradient(eem.Objective.at_end("position", mass))
    assert np.isfinite(gradient.by_position()).all()
    for name in ("k0", "k64"):
        with pytest.raises(eem.GradientError, match="up to 64"):
            gradient.by_parameter(spring, name)
    run.check_gradient(eem.Objective.at_end("position", mass))
    with pytest.raises(eem.GradientError, match="no derivatives by its parameters") as caught:
        run.sensitivities([eem.Input.parameter(spring, "k64")], {"q": ("position", mass)})
    assert caught.value.reason == "NoParameterDerivatives"


def test_a_function_that_raises_ends_a_gradient(oscillator):
    scene, mass, _ = oscillator
    is_wrong = False

    def force(_):
        if is_wrong:
            raise KeyError("gone")
        return [0.0]

    scene.force(mass, force)
    run = scene.simulate("eem-temperature", step=0.1)
    run.keep_history(snapshots=2)
    run.run(until=1.0)
    is_wrong = True
    with pytest.raises(KeyError, match="gone"):
        run.gradient(eem.Objective.at_end("position", mass))


def test_a_constant_force_is_no_function_of_time():
    scene = eem.Scene(dim=1)
    mass = scene.mass(2.0, [0.0], [1.0])
    scene.force(mass, [3.0])
    run = scene.simulate("eem-entropy", step=0.25)
    run.keep_history()
    run.run(until=1.0)
    assert run.gradient(eem.Objective.at_end("position", mass)).by_end_time() == 2.5


@pytest.mark.parametrize("kind", ["gradient", "sensitivities", "check_gradient"])
def test_ctrl_c_ends_what_looks_for_derivatives(oscillator, kind):
    scene, mass, _ = oscillator
    run = scene.simulate("eem-temperature", step=0.1)
    run.keep_history()
    run.run(until=3_000.0, every=None)
    before = run.checkpoint()
    end = eem.Objective.at_end("position", mass)
    asked = {
        "gradient": lambda: run.gradient(end),
        "sensitivities": lambda: run.sensitivities([eem.Input.mass(mass)], {"q": ("position", mass)}),
        "check_gradient": lambda: run.check_gradient(end),
    }
    timer = threading.Timer(0.1, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            asked[kind]()
    timer.join()
    assert run.checkpoint() == before and run.gradient(end).value == run.q[mass, 0]
