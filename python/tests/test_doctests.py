"""The examples in the documents of all modules, which call every public function."""

import doctest
import importlib
import inspect
import pkgutil
import sys

import pytest

import froe

MODULES = ["froe"] + [module.name for module in pkgutil.walk_packages(froe.__path__, "froe.")]
PUBLIC = [name for name in MODULES if not any(part.startswith("_") for part in name.split("."))]


@pytest.mark.parametrize("name", [name for name in MODULES if not name.endswith("_core")])
def test_examples(name):
    failed, tried = doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
    assert not failed


def functions():
    """Path and code of every public function, method and property that is made in a public module."""
    for module in map(importlib.import_module, PUBLIC):
        for owner in [module, *classes(module)]:
            path = ".".join(dict.fromkeys([module.__name__, getattr(owner, "__qualname__", module.__name__)]))
            for name, value in vars(owner).items():
                value = inspect.unwrap(getattr(value, "fget", None) or getattr(value, "func", value))
                made_here = getattr(value, "__module__", None) == module.__name__
                if not name.startswith("_") and inspect.isfunction(value) and made_here:
                    yield f"{path}.{name}", value.__code__


def classes(module):
    return [kind for kind in vars(module).values() if inspect.isclass(kind) and kind.__module__ == module.__name__]


def test_every_public_function_is_called_by_an_example():
    called = set()

    def collect(frame, event, argument):
        if event == "call":
            called.add(frame.f_code)

    for name in PUBLIC:
        sys.setprofile(collect)
        try:
            doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
        finally:
            sys.setprofile(None)
    found = dict(functions())
    assert len(found) > 100
    missing = [path for path, code in found.items() if code not in called]
    assert not missing, ", ".join(missing)
