"""Runs: arrays, control, interruption, errors, copies."""

import copy
import math
import pickle
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import eem
import numpy as np
import pytest

from conftest import Pendulum


def test_shapes_and_types(pendulum):
    record = pendulum.scene.simulate("eem-temperature", step=0.05).run(until=1.0, forces=True)
    assert record.time.shape == (21,) and len(record) == 21
    assert record.q.shape == record.p.shape == (21, 2, 2)
    assert record.theta.shape == record.gamma.shape == (21, 1)
    assert record.position(pendulum.bob).shape == (21, 2)
    for array in (record.time, record.q, record.p, record.theta, record.gamma):
        assert array.dtype == np.float64 and array.flags.c_contiguous and array.flags.writeable
    assert record.ledger.shape == (21,) and record.ledger["energy"].shape == (21,)
    assert record.ledger.linear_momentum.shape == (21, 2)
    assert record.ledger.angular_momentum.shape == (21, 3)
    assert record.certificate.shape == (20,)
    assert record.certificate.iterations.dtype == np.int64
    assert record.certificate.is_bound_wide.dtype == np.bool_
    assert np.array_equal(record.certificate.time, record.time[1:])
    assert np.array_equal(record.stretch(pendulum.spring), np.linalg.norm(record.q[:, 1], axis=1))
    assert record.force(pendulum.spring).shape == (21,)
    assert set(record.to_dict()) >= {"time", "q1_0", "p1_1", "theta0", "gamma0", "energy", "entropy"}
    assert repr(record) == "Record('eem-temperature', rows=21, nodes=2, dim=2, springs=1, until=1.0, end='reached')"


def test_a_record_owns_its_memory(pendulum):
    run = pendulum.scene.simulate("eem-temperature", step=0.05)
    record = run.run(until=1.0)
    before = record.q.copy()
    record.position(pendulum.bob)[:] = 0.0
    run.run(until=2.0)
    assert np.array_equal(record.q, before)


def test_every(pendulum):
    def run(**options):
        return pendulum.scene.simulate("eem-temperature", step=0.05).run(until=1.0, **options)

    whole, thin, ends = run(), run(every=7), run(every=None)
    assert np.array_equal(thin.time, whole.time[[0, 7, 14, 20]])
    assert np.array_equal(thin.q, whole.q[[0, 7, 14, 20]])
    assert np.array_equal(thin.certificate, whole.certificate)
    assert np.array_equal(ends.q, whole.q[[0, -1]])
    assert len(ends.certificate) == 0
    with pytest.raises(ValueError, match="every is 0"):
        run(every=0)
    with pytest.raises(eem.SceneError, match="forces=True"):
        whole.force(pendulum.spring)


def test_a_spring_without_temperature_has_none(oscillator):
    scene, _, spring = oscillator
    run = scene.simulate("eem-entropy", step=0.1)
    record = run.run(until=0.5)
    assert np.isnan(record.theta).all() and record.gamma.shape == (6, 0)
    with pytest.raises(eem.SceneError, match="no temperature"):
        record.temperature(spring)
    with pytest.raises(eem.SceneError, match="no dashpot 0"):
        record.viscous_stretch(spring)
    with pytest.raises(eem.SceneError):
        run.temperature(spring)


def test_numbers_of_a_simulation(oscillator):
    scene, mass, spring = oscillator
    run = scene.simulate("eem-entropy", step=0.1)
    assert (run.time, run.step_size, run.scheme, run.worst_step) == (0.0, 0.1, "eem-entropy", None)
    assert run.stretch(spring) == 1.1 and run.force(spring) == 4.0 * (1.1 - 1.0)
    assert run.ledger().energy == run.internal_energy(spring)
    run.step_size = 0.2
    report = run.step()
    assert report.time == 0.2 and report.step == 0.2 and abs(report.defect) <= report.bound
    assert repr(report).startswith("StepReport(time=0.2, step=0.2, iterations=")
    assert run.worst_step.time == 0.2
    assert run.q.shape == (2, 1) and run.momentum(mass)[0] == run.p[0, 0]
    run.change_scheme("eem-explicit")
    assert run.scheme == "eem-explicit" and run.time == 0.2
    assert repr(run) == "Simulation('eem-explicit', time=0.2, step_size=0.2, nodes=2, springs=1)"


def test_a_scheme_that_cannot_is_refused(oscillator):
    scene, mass, _ = oscillator
    damped = eem.Material("|x: Stretch| x.powi(2)", viscosity={"x": "0.1"})
    scene.spring(damped, [mass, scene.anchor([3.0])])
    run = scene.simulate("eem-entropy", step=0.1)
    run.step()
    before = run.checkpoint()
    with pytest.raises(eem.SceneError, match="eem-explicit"):
        run.change_scheme("eem-explicit")
    assert run.checkpoint() == before and run.scheme == "eem-entropy"


def test_step_control(oscillator):
    scene, *_ = oscillator
    run = scene.simulate("eem-entropy-4", step=0.1)
    assert run.step_statistics is None
    run.control_steps(1e-6, over=10.0)
    run.limit_steps(1e-4, 0.5)
    record = run.run(until=5.0)
    assert run.step_statistics["accepted"] == len(record.certificate)
    assert np.ptp(record.certificate.step) > 0 and record.certificate.step.max() <= 0.5
    run.fix_steps()
    assert run.step_statistics is None
    with pytest.raises(eem.SceneError):
        run.control_steps(-1.0)


def test_a_controller(oscillator):
    scene, mass, _ = oscillator
    run = scene.simulate("eem-entropy", step=0.05)
    for _ in range(100):
        run.set_force(mass, -2.0 * run.momentum(mass))
        run.step()
    # Friction has taken the energy k x²/2 = 0.02 J.
    assert abs(run.ledger().work + 0.02) < 1e-4
    assert abs(run.ledger().balance - 0.02) < 1e-15


def test_callables_are_loads(hooke):
    scene = eem.Scene(dim=1)
    wall, mass = scene.anchor([0.0]), scene.mass(1.0, [1.0])
    scene.spring(hooke, [wall, mass])
    scene.force(mass, lambda t: [math.sin(t)])
    scene.move_anchor(wall, lambda t: [0.1 * t * t])
    record = scene.simulate("eem-entropy-4", step=0.01).run(until=2.0)
    assert record.position(wall)[-1, 0] == pytest.approx(0.4, abs=1e-15)
    # x'' = 4 (0.1 t² − x) + sin t, from x = 0:  x = 0.1 t² − 0.05 + 0.05 cos 2t + sin(t)/3 − sin(2t)/6
    t = record.time
    exact = 1 + 0.1 * t**2 - 0.05 + 0.05 * np.cos(2 * t) + np.sin(t) / 3 - np.sin(2 * t) / 6
    assert np.abs(record.position(mass)[:, 0] - exact).max() < 1e-4
    assert np.ptp(record.ledger.balance) < 1e-14


def test_what_a_callable_raises_comes_out(oscillator):
    scene, mass, _ = oscillator

    def force(t):
        if t > 0.5:
            raise KeyError("no more")
        return [0.0]

    scene.force(mass, force)
    run = scene.simulate("eem-entropy", step=0.1)
    with pytest.raises(KeyError, match="no more"):
        run.run(until=1.0)
    time = run.time
    assert 0.4 < time <= 0.5
    before = run.checkpoint()
    with pytest.raises(KeyError):
        run.step()
    assert run.checkpoint() == before
    scene.force(mass, lambda t: [1.0, 2.0])
    with pytest.raises(ValueError, match="length 1"):
        scene.simulate("eem-entropy", step=0.1).step()


def test_a_callable_cannot_step_its_own_run(oscillator):
    scene, mass, _ = oscillator
    scene.force(mass, lambda t: [run.time if run else 0.0])
    run = None
    run = scene.simulate("eem-entropy", step=0.1)
    with pytest.raises(RuntimeError, match="is running"):
        run.step()


def test_ovens_rockets_and_thermostats(rubber):
    scene = eem.Scene(dim=2)
    nodes = scene.anchor([0, 0]), scene.mass(1.0, [1.0, 0])
    spring = scene.spring(rubber, nodes, temperature=300.0)
    scene.conduct(spring, scene.reservoir(lambda t: 300.0 + 10.0 * t), 100.0)
    scene.rocket(nodes[1], nodes[0], nodes[1], 2.0)
    record = scene.simulate("eem-temperature", step=0.01).run(until=3.0)
    assert record.temperature(spring)[-1] > 320.0
    assert np.ptp(record.ledger.balance) < 1e-9
    held = eem.Scene(dim=2)
    nodes = held.anchor([0, 0]), held.mass(1.0, [1.1, 0])
    spring = held.spring(rubber, nodes, temperature=300.0)
    held.hold_temperature(spring, lambda t: 300.0 + t)
    assert held.simulate("eem-temperature", step=0.1).run(until=1.0).temperature(spring)[-1] == 301.0


def test_a_failed_step_leaves_the_run_unchanged(pendulum):
    run = pendulum.scene.simulate("midpoint", step=0.05)
    run.run(until=1.0)
    run.step_size = 10.0
    before = run.checkpoint()
    with pytest.raises(eem.StepError, match="step from t = 1 s by 10 s failed") as caught:
        run.step()
    error = caught.value
    assert isinstance(error, RuntimeError) and isinstance(error, eem.EemError)
    assert (error.time, error.step, error.failure) == (1.0, 10.0, "NotConverged")
    assert error.shorter < 10.0 and error.law is None
    assert len(error.newton) == 50 and len(error.newton[0]) == 2
    assert run.checkpoint() == before
    with pytest.raises(eem.StepError) as caught:
        run.run(until=100.0)
    record = caught.value.record
    assert record.end == "failed" and record.time[-1] == run.time
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and np.array_equal(again.record.q, record.q)
    with pytest.raises(eem.StepError, match="end time"):
        run.run(until=0.5)


def test_ctrl_c_returns_the_record_so_far(pendulum):
    run = pendulum.scene.simulate("eem-temperature", step=0.01)
    timer = threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT))
    start = time.perf_counter()
    timer.start()
    record = run.run(until=1e9, every=100)
    assert time.perf_counter() - start < 30.0
    timer.join()
    assert record.end == "interrupted" and 0.0 < record.time[-1] < 1e9
    assert record.time[-1] == run.time
    assert run.run(until=run.time + 1.0).end == "reached"


def test_ctrl_c_within_a_function_of_time_returns_the_record_so_far(pendulum):
    is_late = False

    def force(t):
        if is_late and t > 0.5:
            raise KeyboardInterrupt
        return [0.0, 0.0]

    scene = copy.copy(pendulum.scene)
    scene.force(scene.nodes[1], force)
    run = scene.simulate("eem-temperature", step=0.1)
    is_late = True
    record = run.run(until=1.0)
    assert record.end == "interrupted" and record.time[-1] == run.time < 1.0
    is_late = False
    assert run.run(until=1.0).end == "reached"


def test_other_signals_raise_what_their_handler_raises(pendulum):
    class Alarm(Exception):
        pass

    def handler(*_):
        raise Alarm

    before = signal.signal(signal.SIGUSR1, handler)
    try:
        timer = threading.Timer(0.2, lambda: signal.raise_signal(signal.SIGUSR1))
        timer.start()
        with pytest.raises(Alarm):
            pendulum.scene.simulate("eem-temperature", step=0.01).run(until=1e9, every=None)
        timer.join()
    finally:
        signal.signal(signal.SIGUSR1, before)


def test_copies_and_pickles_go_on_with_the_same_bits(pendulum):
    run = pendulum.scene.simulate("auto", step=0.01, tolerance=1e-6)
    run.run(until=1.0)
    twins = [pickle.loads(pickle.dumps(run)), copy.copy(run), copy.deepcopy(run)]
    record = run.run(until=2.0)
    for twin in twins:
        other = twin.run(until=2.0)
        assert np.array_equal(other.q, record.q) and np.array_equal(other.theta, record.theta)
        assert np.array_equal(other.ledger, record.ledger)
        assert np.array_equal(other.temperature(pendulum.spring), record.temperature(pendulum.spring))
    saved = pickle.loads(pickle.dumps(record))
    assert np.array_equal(saved.q, record.q) and saved.end == "reached"
    assert np.array_equal(saved.temperature(pendulum.spring), record.temperature(pendulum.spring))


def test_checkpoints(pendulum, oscillator):
    run = pendulum.scene.simulate("eem-entropy", step=0.01)
    run.run(until=1.0)
    saved = run.checkpoint()
    on = run.run(until=2.0)
    again = pendulum.scene.simulate("eem-entropy", step=0.5)
    again.restore(saved)
    assert np.array_equal(again.run(until=2.0).q, on.q)
    before = again.checkpoint()
    scene, *_ = oscillator
    other = scene.simulate("eem-entropy", step=0.1)
    for wrong, where in [("{}", again), ("", again), (saved, other), (saved.replace("1", "2", 3), again)]:
        with pytest.raises(eem.CheckpointError):
            where.restore(wrong)
    assert again.checkpoint() == before


def test_threads_run_side_by_side(rubber):
    def member(_):
        pendulum = Pendulum(rubber)
        return pendulum.scene.simulate("eem-temperature", step=0.01).run(until=20.0).q

    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(member, range(8)))
    assert all(np.array_equal(result, results[0]) for result in results)


def test_the_interpreter_is_free_while_a_run_goes_on(pendulum):
    run = pendulum.scene.simulate("eem-temperature", step=0.01)
    thread = threading.Thread(target=lambda: run.run(until=200.0, every=None))
    thread.start()
    seen = 0
    while thread.is_alive():
        try:
            run.step()
        except RuntimeError as error:
            assert "is running" in str(error)
            seen += 1
        time.sleep(0.001)
    thread.join()
    assert seen > 0
    assert run.time >= 200.0


def test_a_tolerance_needs_no_step():
    """x = 1 + (F/k)(t² − 2 (1 − cos ωt)/ω²) of a mass at rest that is pushed by F t²."""
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.0])
    hooke = eem.Material("|x: Stretch| 0.5 * k * (x - 1).powi(2)", k=100.0)
    scene.spring(hooke, [scene.anchor([0.0]), mass])
    scene.force(mass, lambda t: [5.0 * t * t])
    run = scene.simulate("auto", tolerance=1e-6)
    run.run(until=2.0)
    exact = 1.0 + 0.05 * (4.0 - 0.02 * (1.0 - math.cos(20.0)))
    assert abs(run.position(mass)[0] - exact) < 1e-6
    assert run.step_statistics["accepted"] < 100
    with pytest.raises(eem.SceneError, match="give a `step`, a `tolerance`, or both"):
        scene.simulate("auto")


def test_steps_end_where_a_load_jumps():
    scene = eem.Scene(dim=1)
    mass = scene.mass(2.0, [1.0])
    scene.force(mass, lambda t: [0.0 if t < 0.7 else 10.0])
    scene.stop_at([0.7])
    scene.shortest_load(0.1)
    run = scene.simulate("eem-temperature", step=0.5)
    record = run.run(until=1.7)
    assert 0.7 in record.time
    assert abs(run.momentum(mass)[0] - 10.0) < 1e-14
    with pytest.raises(eem.SceneError):
        scene.stop_at([math.inf])
    with pytest.raises(eem.SceneError):
        scene.shortest_load(0.0)


def test_steps_beyond_a_relaxation_time_are_warned_of():
    scene = eem.Scene(dim=1)
    body = eem.Material(
        "|x: Stretch, theta: Temperature| 0.5 * (x - 1).powi(2) + c * (theta - theta * ln(theta / 300))", c=15.0)
    ends = scene.anchor([0.0]), scene.anchor([1.0])
    hot, cold = (scene.spring(body, ends, temperature=t) for t in (373.15, 273.15))
    scene.conduct(hot, cold, 1e6)
    run = scene.simulate("eem-temperature", step=1.0)
    assert run.warning is None
    with pytest.warns(UserWarning, match="eem-damped"):
        run.run(until=10.0)
    record = run.run(until=20.0)  # only once
    assert record.ledger.unresolved[-1] == 2 * 20
    damped = scene.simulate("eem-damped", step=1.0)
    damped.run(until=1.0)
    assert damped.warning is None
    # What is left of the difference falls with 1/κ: 0.76 K W/K / κ for κ from 1e3 to 1e8 W/K.
    assert 323.15 - damped.temperature(hot) == pytest.approx(0.756 / 1e6, rel=2e-3)


@pytest.mark.parametrize(
    ("end", "message"),
    [
        ({"until": math.inf}, "where no run would end"),
        ({"until": math.nan}, "where no run would end"),
        ({"times": [0.1, math.inf]}, r"times\[1\] is inf, it must be finite"),
    ],
)
def test_a_run_without_an_end_is_refused(pendulum, end, message):
    run = pendulum.scene.simulate("eem-temperature", step=0.05)
    with pytest.raises(eem.SceneError, match=message):
        run.run(**end)
    assert run.time == 0.0


def test_an_ensemble_is_many_runs(rubber):
    pendulum = Pendulum(rubber)
    k = np.linspace(80.0, 120.0, 9)
    times = [0.5, 1.0]
    found = pendulum.scene.ensemble({rubber: {"k": k}}, "eem-temperature", step=0.02, times=times)
    assert found.q.shape == (9, 2, 2, 2) and found.theta.shape == (9, 2, 1)
    assert found.ledger.energy.shape == (9, 2) and found.ok.all() and len(found) == 9
    assert found.temperature(pendulum.spring).shape == (9, 2)
    for member, value in enumerate(k):
        single = Pendulum(rubber.replace(k=value)).scene
        record = single.simulate("eem-temperature", step=0.02).run(until=1.0)
        assert np.array_equal(found.q[member, 1], record.q[-1])
        assert found.ledger[member, 1] == record.ledger[-1]
    one = pendulum.scene.ensemble({rubber: {"k": k}}, "eem-temperature", step=0.02, until=1.0, threads=1)
    assert np.array_equal(one.q[:, 0], found.q[:, 1])
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.ledger.energy, found.ledger.energy)


def test_members_that_fail_say_why(rubber):
    pendulum = Pendulum(rubber)
    found = pendulum.scene.ensemble({rubber: {"c": [1.0, -1.0]}}, "eem-temperature", step=0.02, until=1.0)
    assert list(found.ok) == [True, False]
    assert isinstance(found.errors[1], eem.EemError)
    assert np.isnan(found.q[1]).all() and np.isfinite(found.q[0]).all()
    assert repr(found) == "EnsembleRecord('eem-temperature', members=2, times=1, failed=1)"
    with pytest.raises(eem.EemError):
        found.raise_first()


@pytest.mark.parametrize(
    ("vary", "options", "message"),
    [
        ({}, {"until": 1.0}, "nothing varies"),
        ({"k": [1.0, 2.0], "c": [1.0]}, {"until": 1.0}, "2 values, `c` 1"),
        ({"k": 1.0}, {"until": 1.0}, "a list with a value for each member"),
        ({"k": [1.0]}, {}, "give the end"),
        ({"k": [1.0]}, {"until": 1.0, "times": [1.0]}, "give the end"),
    ],
)
def test_wrong_ensembles(pendulum, rubber, vary, options, message):
    with pytest.raises(eem.SceneError, match=message):
        pendulum.scene.ensemble({rubber: vary}, "eem-entropy", step=0.1, **options)


def test_ensembles_vary_parameters_of_their_own_materials(pendulum, rubber, hooke):
    with pytest.raises(eem.SceneError, match="no spring of the scene"):
        pendulum.scene.ensemble({hooke: {"k": [1.0]}}, "eem-entropy", step=0.1, until=1.0)
    with pytest.raises(eem.MaterialError, match="there is no parameter"):
        pendulum.scene.ensemble({rubber: {"m": [1.0]}}, "eem-entropy", step=0.1, until=1.0)


def test_ctrl_c_ends_an_ensemble(pendulum, rubber):
    timer = threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    k = np.linspace(80.0, 120.0, 50_000)
    found = pendulum.scene.ensemble({rubber: {"k": k}}, "eem-temperature", step=0.01, until=10.0)
    timer.join()
    assert not found.ok.all() and "stopped" in str(found.errors[-1])


def test_every_class_of_errors_is_an_eem_error():
    classes = [eem.MaterialError, eem.SceneError, eem.StepError, eem.EquilibriumError, eem.CheckpointError]
    for error in classes:
        assert issubclass(error, eem.EemError)
        again = pickle.loads(pickle.dumps(error("text")))
        assert type(again) is error and str(again) == "text"
    assert eem.__version__.count(".") == 2
