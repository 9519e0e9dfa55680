"""The examples in the documents of all modules."""

import doctest
import importlib
import pkgutil

import pytest

import froe

MODULES = ["froe"] + [module.name for module in pkgutil.walk_packages(froe.__path__, "froe.")]


@pytest.mark.parametrize("name", [name for name in MODULES if not name.endswith("_core")])
def test_examples(name):
    failed, tried = doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
    assert not failed
