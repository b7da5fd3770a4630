"""Every example runs, keeps the claims that it checks itself, and draws its picture."""

import doctest
import os
import subprocess
import sys
from pathlib import Path

import eem
import pytest

EXAMPLES = sorted((Path(__file__).parent.parent / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example(example, tmp_path):
    picture = tmp_path / "picture.png"
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    subprocess.run([sys.executable, "-W", "error", example, picture], check=True, env=environment)
    assert picture.stat().st_size > 1000


@pytest.mark.parametrize("item", [eem, eem.Input, eem.Material, eem.Objective, eem.Scene, eem.Simulation], ids=lambda item: item.__name__)
def test_examples_of_doc_strings(item):
    runner = doctest.DocTestRunner()
    for test in doctest.DocTestFinder().find(item, item.__name__, globs={}):
        runner.run(test)
    assert runner.summarize().failed == 0


def test_the_programs_of_the_readme():
    text = (Path(__file__).parent.parent / "README.md").read_text()
    programs = [part.split("```")[0] for part in text.split("```python\n")[1:]]
    assert programs
    for program in programs:
        exec(compile(program, "README.md", "exec"), {})
