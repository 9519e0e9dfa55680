"""The examples of docs/howto/python.md."""

import doctest
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/howto/python.md"


def test_examples():
    failed, tried = doctest.testfile(str(PAGE), module_relative=False)
    assert tried > 5 and not failed
