"""The tests use the froe that is installed, or else the package in place: python/src."""

import importlib.util
import sys
from pathlib import Path

if importlib.util.find_spec("froe") is None:
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "src"))
