"""Every example runs, keeps the claims that it checks itself, and draws its picture."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).parent.parent / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example(example, tmp_path):
    picture = tmp_path / "picture.png"
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    subprocess.run([sys.executable, "-W", "error", example, picture], check=True, env=environment)
    assert picture.stat().st_size > 1000


def test_the_doc_string_of_the_package():
    import doctest

    import eem

    assert doctest.testmod(eem).attempted > 5
    assert doctest.testmod(eem).failed == 0


def test_the_programs_of_the_readme():
    text = (Path(__file__).parent.parent / "README.md").read_text()
    programs = [part.split("```")[0] for part in text.split("```python\n")[1:]]
    assert programs
    for program in programs:
        exec(compile(program, "README.md", "exec"), {})
