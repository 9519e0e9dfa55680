"""The notebooks of docs/tutorials/python run, print what they show, and draw something; scripts/check-notebooks says
how. So the tests below it: a notebook that raises, prints something else or draws nothing is found."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((ROOT / "docs/tutorials/python").glob("*.ipynb"))
CHECK = ROOT / "scripts/check-notebooks"


def check(*arguments):
    """The exit status, and what is printed. Where all is well, not what ZeroMQ says of a kernel that ends."""
    done = subprocess.run([sys.executable, CHECK, *map(str, arguments)], capture_output=True, text=True, timeout=3600)
    return done.returncode, done.stdout + (done.stderr if done.returncode else "")


def test_there_are_notebooks():
    assert [path.stem for path in NOTEBOOKS] == ["maps", "models", "motion", "rays"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(path):
    status, printed = check(path)
    assert status == 0 and printed == "", printed


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_page_of_the_site_shows_every_cell(path, tmp_path):
    spec = importlib.util.spec_from_file_location("notebooks", ROOT / "scripts/site/notebooks.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    page = script.as_markdown(path, tmp_path)
    cells = nbformat.read(path, as_version=4).cells
    shown = [kind for cell in cells for output in cell.get("outputs", []) for kind in output.get("data", {})]
    pictures = re.findall(r'<img class="drawn" src="([^"]+)"', page)
    assert len(pictures) == len(set(pictures)) == sum(kind.startswith("image/") for kind in shown)
    assert all((tmp_path / name).stat().st_size > 1000 for name in pictures)
    assert all(cell.source.rstrip() in page for cell in cells)


def notebook(path, *cells):
    made = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbformat.write(made, path)
    return path


@pytest.mark.parametrize(
    ("cell", "fault"),
    [
        ("1 / 0", "cell 1: it raises ZeroDivisionError: division by zero"),
        ("print(6 * 7)", "and prints\n42"),
        ("import warnings; warnings.warn('old')", "cell 1: it warns"),
        ("from matplotlib import pyplot; pyplot.figure().add_subplot().set_axis_off()", "a picture is empty"),
        ("from IPython.display import SVG; SVG('<svg xmlns=\"http://www.w3.org/2000/svg\"/>')", "an SVG without shapes"),
        ("from matplotlib import pyplot; pyplot.plot([1, 2]);", "has no pictures in the file, and shows ['image/png']"),
    ],
    ids=["raises", "prints", "warns", "blank", "blank svg", "new picture"],
)
def test_faults_are_found(tmp_path, cell, fault):
    status, printed = check(notebook(tmp_path / "a.ipynb", cell))
    assert status == 1 and fault in printed


def test_accepted_output_is_what_is_compared(tmp_path):
    path = notebook(tmp_path / "a.ipynb", "from matplotlib import pyplot; pyplot.plot([1, 2]);", "print('one'); 2")
    assert check(path)[0] == 1
    assert check("--accept", path) == (0, "")
    assert check(path) == (0, "")
    broken = notebook(tmp_path / "b.ipynb", "1 / 0")
    before = broken.read_text()
    assert check("--accept", broken)[0] == 1 and broken.read_text() == before


def test_dots_stand_for_anything(tmp_path):
    path = notebook(tmp_path / "a.ipynb", "print('before', id(object()), 'after')")
    assert check("--accept", path) == (0, "")
    kept = nbformat.read(path, as_version=4)
    kept.cells[0].outputs[0].text = "before ... after\n"
    nbformat.write(kept, path)
    assert check(path) == (0, "")
    assert check("--accept", path) == (0, "") and "before ... after" in path.read_text()
