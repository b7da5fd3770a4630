"""Studies: errors of a mass on a spring, what is recommended, what is refused, and how they end."""

import math
import signal
import threading
import time
import types
from concurrent.futures import ThreadPoolExecutor

import eem
import numpy as np
import pytest

STEPS = [0.1, 0.05, 0.025]
SCHEMES = {"eem-entropy": {"steps": STEPS, "tolerances": [1e-3]}, "variational-4": {"steps": STEPS}}


@pytest.fixture
def report(oscillator):
    scene, _, _ = oscillator
    return scene.study(1.0, SCHEMES)


def test_errors_of_a_mass_on_a_spring(report):
    # The phase ωt = 2 is late by (ωh)² ωt/12 at second order.
    for row, h in zip(report.rows[:3], STEPS, strict=True):
        assert (row.scheme, row.step, row.tolerance) == ("eem-entropy", h, None)
        late = (2.0 * h) ** 2 * 2.0 / 12.0
        assert row.error_q == pytest.approx(0.1 * math.sin(2.0) * late / (1.0 + 0.1 * math.cos(2.0)), rel=0.02)
        # |Δp|/max|p| with p = -0.2 sin ωt, whose largest value is at ωt = π/2
        assert row.error_p == pytest.approx(abs(math.cos(2.0)) * late, rel=0.05)
        assert row.error("q") == row.error_q and row.largest_error == row.error_p
        assert row.error_theta is None and row.error_gamma is None and row.refused == {}
        assert row.steps == round(1.0 / h) and row.rejected == 0 and row.failure is None
        assert row.energy_defect < 1e-14 and 0.0 < row.seconds <= row.median_seconds
    controlled = report.rows[3]
    assert (controlled.step, controlled.tolerance) == (None, 1e-3) and controlled.error_q < 1e-3
    assert report.order("eem-entropy") == pytest.approx(2.0, abs=0.05)
    assert report.order("variational-4", "p") == pytest.approx(4.0, abs=0.05)
    assert report.order("eem-entropy", "theta") is None and report.order("midpoint") is None


def test_errors_are_those_of_runs(oscillator, report):
    scene, mass, _ = oscillator
    run = scene.simulate("eem-entropy", step=0.1)
    run.run(until=1.0)
    fine = scene.simulate("gauss-4", step=1e-3)
    fine.run(until=1.0)
    q, exact = run.position(mass)[0], fine.position(mass)[0]
    assert report.rows[0].error_q == pytest.approx(abs(q - exact) / exact, rel=1e-6)


def test_recommendations(report):
    advice = report.recommend(1e-5)
    assert advice.fastest is not None and advice.fastest.largest_error <= 1e-5
    assert advice.fastest in report.front and advice.fastest in report.rows
    assert advice.fastest.scheme == "variational-4" and advice.lawful is None and advice.closest is None
    assert str(advice).startswith("For errors of at most 0.00001: variational-4 with h = ") or "1e-5" in str(advice)
    loose = report.recommend(1e-2)
    assert loose.lawful is not None and loose.lawful.scheme == "eem-entropy"
    only_q = report.recommend(1e-2, ["q"])
    assert only_q.quantities == ("q",) and "in the positions" in str(only_q)
    never = report.recommend(1e-9)
    assert never.fastest is None and never.closest is not None
    assert never.closest.largest_error == min(row.largest_error for row in report.rows)
    refused = report.recommend(1e-15)
    assert refused.fastest is None and refused.refused is not None and refused.refused[0] in ("q", "p")
    assert "references of your own" not in str(refused)
    front = report.front
    assert [row.seconds for row in front] == sorted(row.seconds for row in front)
    errors = [row.largest_error for row in front]
    assert errors == sorted(errors, reverse=True)


def test_tables(report):
    assert len(report) == len(report.rows) == 7 and report.duration == 1.0
    shown = str(report)
    assert shown.startswith("| scheme ") and "Orders of q" in shown and shown.count("For errors of at most") == 3
    assert repr(report) == "StudyReport(duration=1.0, settings=7)"
    lines = report.csv().splitlines()
    assert len(lines) == 8 and lines[0].startswith("scheme,tolerance,step,error_q")
    assert float(lines[1].split(",")[3]) == report.rows[0].error_q
    table = report.to_dict()
    assert {column.shape for column in table.values()} == {(7,)}
    assert table["error_q"].tolist() == [row.error_q for row in report.rows]
    assert np.isnan(table["error_theta"]).all() and np.isnan(table["step"][3])
    with pytest.raises(AttributeError):
        report.rows[0].steps = 3


def test_a_thermal_scene_and_a_setting_that_fails(pendulum):
    # Newton's method does not converge in a step of 2 s of the midpoint rule.
    report = pendulum.scene.study(2.0, ["eem-temperature", "midpoint"], steps=[2.0, 0.02], accuracies=[0.1], repeats=1)
    assert [row.failure is None for row in report.rows] == [True, True, False, True]
    failed = report.rows[2]
    assert isinstance(failed.failure, eem.StepError) and failed.failure.failure == "NotConverged"
    assert failed.steps == 0 and failed.error_q is None and failed.largest_error is None
    fine = report.rows[1]
    assert fine.error_theta is not None and fine.error_gamma is not None and fine.least_entropy_change > 0.0
    assert report.recommend(0.1, ["theta"]).fastest is not None
    assert "failed" in str(report)


def test_functions_of_time_and_another_start(oscillator):
    scene, mass, _ = oscillator
    scene.start_at(0.5)
    scene.force(mass, lambda t: [math.cos(t)])
    report = scene.study(1.0, "eem-entropy", steps=[0.1, 0.05], repeats=1)
    assert report.order("eem-entropy") == pytest.approx(2.0, abs=0.1)
    run = scene.simulate("eem-entropy", step=0.1)
    run.run(until=1.5)
    fine = scene.simulate("gauss-4", step=1e-3)
    fine.run(until=1.5)
    off = abs(run.position(mass)[0] - fine.position(mass)[0]) / fine.position(mass)[0]
    assert report.rows[0].error_q == pytest.approx(off, rel=1e-6)


def test_what_a_function_raises_comes_out(oscillator):
    scene, mass, _ = oscillator
    calls = []

    def force(time):
        calls.append(time)
        if time > 0.5:
            raise KeyError("gone")
        return [0.0]

    scene.force(mass, force)
    with pytest.raises(KeyError, match="gone"):
        scene.study(1.0, "eem-entropy", steps=[0.1] * 100)
    # After the first run.
    assert len(calls) < 100


def test_what_is_refused(oscillator):
    scene, _, _ = oscillator
    for refused, message in [
        (lambda: scene.study(1.0, "eem-entropy"), "nothing to run"),
        (lambda: scene.study(1.0, [], steps=[0.1]), "nothing to run"),
        (lambda: scene.study(1.0, "eem-entropy", steps=[-0.1]), "not positive and finite"),
        (lambda: scene.study(1.0, "eem-entropy", steps=0.1), "steps has the shape a number"),
        (lambda: scene.study(1.0, "eem-entropy", steps=[0.3]), "no whole number of steps"),
        (lambda: scene.study(-1.0, "eem-entropy", steps=[0.1]), "end time"),
        (lambda: scene.study(float("nan"), "eem-entropy", steps=[0.1]), "end time"),
        (lambda: scene.study(1.0, "eem-entropy", tolerances=[-1.0]), "tolerance"),
        (lambda: scene.study(1.0, "eem-entropy", steps=[0.1], accuracies=[0.0]), "accuracy of 0"),
        (lambda: scene.study(1.0, {"eem-entropy": {"step": [0.1]}}), 'no "step": give steps or tolerances'),
        (lambda: scene.study(1.0, {"eem-entropy": {"steps": [0.1]}}, tolerances=[0.1]), "leave out"),
        (lambda: scene.study(1.0, "variational-4", tolerances=[0.1]), "must have one size"),
    ]:
        with pytest.raises(eem.SceneError, match=message):
            refused()
    with pytest.raises(ValueError, match="there is no scheme"):
        scene.study(1.0, ["euler"], steps=[0.1])
    with pytest.raises(TypeError):
        scene.study(1.0, 3, steps=[0.1])
    report = scene.study(1.0, "eem-entropy", steps=[0.1], repeats=1)
    with pytest.raises(eem.SceneError, match="none of the quantities"):
        report.recommend(1e-3, ["theta"])
    assert report.recommend(1.0, "q").quantities == report.recommend(1.0, iter(["q"])).quantities == ("q",)
    with pytest.raises(eem.SceneError, match="accuracy of -1"):
        report.recommend(-1.0)
    with pytest.raises(eem.SceneError, match="no errors of \"energy\""):
        report.order("eem-entropy", "energy")
    with pytest.raises(ValueError, match="no errors of 'energy'"):
        report.rows[0].error("energy")
    assert repr(scene) == "Scene(dim=1, nodes=2, springs=1, reservoirs=0, paths=0)"


def test_ctrl_c_ends_a_study(pendulum):
    timer = threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT))
    start = time.perf_counter()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pendulum.scene.study(1.0, "eem-temperature", steps=[0.001] * 100_000)
    assert time.perf_counter() - start < 30.0
    timer.join()
    # Also within a run, which would take hours.
    timer = threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pendulum.scene.study(1e7, "eem-temperature", steps=[0.01])
    timer.join()
    assert pendulum.scene.study(1.0, "eem-temperature", steps=[0.1], repeats=1).rows[0].steps == 10


def test_studies_of_one_scene_in_several_threads(pendulum):
    study = lambda _: pendulum.scene.study(0.1, "eem-entropy", steps=[0.01], repeats=1).rows[0].energy_defect
    with ThreadPoolExecutor(4) as pool:
        assert len(set(pool.map(study, range(40)))) == 1


def test_schemes_have_settings_of_their_own_in_any_mapping(pendulum):
    own = types.MappingProxyType({"auto": types.MappingProxyType({"steps": [0.05]})})
    report = pendulum.scene.study(0.1, own, repeats=1)
    assert report.rows[0].steps == 2 and "auto with constant h = 0.05 s" in str(report)
    with pytest.raises(eem.SceneError, match='auto: give {"steps": …}'):
        pendulum.scene.study(0.1, {"auto": [0.05]})


def test_other_threads_go_on(pendulum):
    seen = []
    thread = threading.Thread(target=lambda: seen.append(pendulum.scene.study(1.0, "eem-entropy", steps=[0.01])))
    thread.start()
    count = 0
    while thread.is_alive():
        count += 1
        time.sleep(1e-3)
    thread.join()
    assert count > 3 and len(seen[0]) == 1
