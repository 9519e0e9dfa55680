"""The reference that scripts/site/python_reference.py writes has every public name of the package as it is imported, and
nothing of it is undocumented: each function has a text, names each of its arguments, and says what it costs, what it
raises and, by an example, how it is called."""

import dataclasses
import importlib
import importlib.util
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import froe

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts/site/python_reference.py"
COMPATIBLE = ["froe.compat.pyvista", "froe.compat.shapely", "froe.compat.trimesh"]
MODULES = [*COMPATIBLE, "froe.errors", "froe.measure", "froe.mpl"]
FOR_THE_EXTENSION = {"froe.errors.of_status", "froe.errors.of_name"}
PLAIN = (int, float, str, tuple, dict)


def made_here(value, module):
    return (inspect.isclass(value) or inspect.isfunction(value)) and value.__module__ == module.__name__


def named():
    """Path and value of every public class and function."""
    for name in froe.__all__:
        value = getattr(froe, name)
        if not (name.startswith("_") or inspect.ismodule(value) or value.__module__ in MODULES):
            yield f"froe.{name}", value
    for module in map(importlib.import_module, MODULES):
        for name, value in vars(module).items():
            if not name.startswith("_") and made_here(value, module):
                yield f"{module.__name__}.{name}", value


def members(path, kind):
    for base in kind.__mro__:
        for name, value in vars(base).items() if base.__module__.startswith("froe.") else ():
            if not name.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                yield f"{path}.{name}", value


CLASSES = {path: value for path, value in named() if inspect.isclass(value)}
FUNCTIONS = {path: value for path, value in named() if inspect.isfunction(value)}
METHODS = {path: (value, kind) for of, kind in CLASSES.items() for path, value in members(of, kind)}
CALLED = {**{path: (value, None) for path, value in FUNCTIONS.items()}, **METHODS}
CALLED = {path: found for path, found in CALLED.items() if path not in FOR_THE_EXTENSION}


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """The paths of all names that it has, and its text."""
    spec = importlib.util.spec_from_file_location("python_reference", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    folder = tmp_path_factory.mktemp("reference")
    return script.write(folder), {page.name: page.read_text(encoding="utf-8") for page in folder.glob("*.md")}


def test_every_public_name_is_there_once(reference):
    paths, _ = reference
    assert sorted(paths) == sorted({*CLASSES, *FUNCTIONS, *METHODS} - FOR_THE_EXTENSION)


def test_every_signature_is_that_of_the_package(reference):
    text = "\n".join(reference[1].values())
    for path, (value, kind) in CALLED.items():
        if isinstance(value, property):
            continue
        shown = re.search(rf"^{re.escape(path)}\((.*?)\n?\)( -> .*)?$", text, re.M | re.S)
        assert shown, path
        for name, argument in inspect.signature(value).parameters.items():
            assert name == "self" or argument.kind is argument.VAR_KEYWORD or re.search(rf"\b{name}\b", shown[1]), (path, name)


def test_every_link_leads_somewhere(reference):
    _, pages = reference
    for text in pages.values():
        for page, place in re.findall(r"\]\((\w+\.md)#([\w-]+)\)", text):
            assert f"{{#{place}}}" in pages[page], (page, place)


def test_sentences_are_short_and_plain(reference, tmp_path):
    for name, text in reference[1].items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    command = [sys.executable, ROOT / "scripts/check-prose", *sorted(tmp_path.glob("*.md"))]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def around(value, kind):
    """All texts that speak of a function: its own, that of its class, and that of its module."""
    return "\n".join(inspect.getdoc(one) or "" for one in (value, kind, inspect.getmodule(kind or value)) if one)


@pytest.mark.parametrize("path", CLASSES)
def test_class(path):
    kind = CLASSES[path]
    text = inspect.getdoc(kind) if kind.__doc__ else None
    assert text, f"{path} has no text"
    fields = dataclasses.fields(kind) if dataclasses.is_dataclass(kind) else []
    missing = [field.name for field in fields if not re.search(rf"\b{field.name}\b", text)]
    assert not missing, f"{path} says nothing about {', '.join(missing)}"


@pytest.mark.parametrize("path", CALLED)
def test_function(path):
    value, kind = CALLED[path]
    name = path.rpartition(".")[2]
    own, text = inspect.getdoc(value), around(value, kind)
    assert own, f"{path} has no text"
    examples = "\n".join(line for line in text.splitlines() if line.lstrip().startswith((">>> ", "... ")))
    assert re.search(rf"\b{name}\b", examples) or isinstance(value, property), f"{path} has no example"
    if isinstance(value, property):
        return
    for argument in inspect.signature(value).parameters:
        assert argument == "self" or re.search(rf"\b{argument}\b", text.replace(examples, "")), f"{path}: {argument}"
    assert ":cost:" in own, f"{path} does not say what it costs"
    assert re.search("^:raises[ :]", text, re.M), f"{path} does not say what it raises"
