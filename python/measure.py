"""What Python costs: times of runs against those of `springs/src/bin/reference.rs`, which does the same without Python.

    cargo build --release -p eem-python -p eem-springs --bin reference
    python measure.py target/release/reference

Both are run in turn; the fastest of each counts.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent / "tests"))
from conftest import PSI, VALUES, Pendulum  # noqa: E402

import eem  # noqa: E402

REPEATS = 7


def rubber():
    return eem.Material(PSI, viscosity={"gamma": "eta * exp(a / theta)"}, **VALUES)


def steps(every):
    run = Pendulum(rubber()).scene.simulate("eem-temperature", step=0.01)
    run.run(until=1.0, every=None)
    start = time.perf_counter()
    run.run(until=1001.0, every=every)
    return time.perf_counter() - start


def single_steps():
    run = Pendulum(rubber()).scene.simulate("eem-temperature", step=0.01)
    run.run(until=1.0, every=None)
    start = time.perf_counter()
    for _ in range(100_000):
        run.step()
    return time.perf_counter() - start


def ensemble():
    material = rubber()
    scene = Pendulum(material).scene
    k = 90.0 + 0.02 * np.arange(1000)
    start = time.perf_counter()
    scene.ensemble({material: {"k": k}}, "eem-temperature", step=0.01, until=10.0).raise_first()
    return time.perf_counter() - start


def reference(what):
    done = subprocess.run([sys.argv[1], what], check=True, capture_output=True, text=True)
    return float(done.stdout)


def compare(name, what, own):
    times = [(reference(what), own()) for _ in range(REPEATS)]
    rust, python = (min(column) for column in zip(*times))
    print(f"{name:44} {rust:8.3f} s  {python:8.3f} s  {100 * (python / rust - 1):+6.1f} %")


print(f"{'':44} {'Rust':>10}  {'Python':>10}")
compare("100 000 steps, first and last state", "steps", lambda: steps(None))
compare("100 000 steps, every state with its balances", "steps", lambda: steps(1))
compare("100 000 steps by step()", "steps", single_steps)
compare("1 000 pendulums with 1 000 steps", "ensemble", ensemble)
