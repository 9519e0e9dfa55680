"""The examples of docs/howto/python.md, and the programs in Python of README.md with what they print."""

import contextlib
import doctest
import io
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/howto/python.md"
PROGRAM = re.compile(r"^```python\n(?P<program>.*?)^```\n\n```text\n(?P<printed>.*?)^```$", re.M | re.S)
PROGRAMS = list(PROGRAM.finditer((ROOT / "README.md").read_text(encoding="utf-8")))


def test_examples(monkeypatch):
    monkeypatch.chdir(ROOT)
    failed, tried = doctest.testfile(str(PAGE), module_relative=False)
    assert tried > 5 and not failed


def test_readme_has_programs():
    assert PROGRAMS and len(PROGRAMS) == (ROOT / "README.md").read_text(encoding="utf-8").count("```python\n")


@pytest.mark.parametrize("match", PROGRAMS, ids=range(len(PROGRAMS)))
def test_readme(match):
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(match["program"], "README.md", "exec"), {})
    assert printed.getvalue() == match["printed"]
