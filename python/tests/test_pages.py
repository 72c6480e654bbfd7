"""Examples in the documentation run, docstrings are numpydoc's, and types hold."""

import doctest
import importlib.util
import os
import pathlib
import pkgutil
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

import deldrift

PACKAGE = pathlib.Path(deldrift.__file__).resolve().parent
PYTHON = pathlib.Path(__file__).resolve().parent.parent
MODULES = [f"deldrift.{module.name}" for module in pkgutil.iter_modules([str(PACKAGE)])]
MODULES = ["deldrift"] + [name for name in MODULES if not name.endswith("libdeldrift")]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.parametrize("page", ["docs/PYTHON.md"])
def test_pages(page):
    path = PYTHON.parent / page
    if not path.exists():
        pytest.skip("the page is in the sources alone")
    if np.lib.NumpyVersion(np.__version__) < "2.0.0":
        pytest.skip("the page shows numbers as NumPy 2 does")
    failed, tried = doctest.testfile(str(path), module_relative=False, globs={"deldrift": deldrift})
    assert tried > 20 and failed == 0


@pytest.mark.parametrize("page", ["README.md", "../docs/GEOMETRY.md", "../docs/PERIODIC.md"])
def test_programs_on_pages(page):
    path = PYTHON / page
    if not path.exists():
        pytest.skip("the page is in the sources alone")
    programs = re.findall(r"```python\n(.*?)```", path.read_text(), re.S)
    assert programs
    for program in programs:
        exec(program, {})


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_types(tmp_path):
    # A copy, as mypy looks less closely at what is installed.
    shutil.copytree(PACKAGE, tmp_path / "deldrift", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    command = [sys.executable, "-m", "mypy", "--config-file", str(PYTHON / "pyproject.toml"), "deldrift"]
    result = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert result.returncode == 0, result.stdout


PROGRAM = """
import numpy as np
import deldrift

tri = deldrift.Delaunay(np.zeros((3, 2)), threads=1, progress=print)
report: deldrift.Report = tri.move([[0, 0], [1, 0], [0, 1]])
moved: int = report.moved
with tri.step() as step:
    ids: np.ndarray = step.insert([[1.0, 1.0]])
created: np.ndarray = tri.changes().created
segments: np.ndarray = tri.add_segments([[0, 1]])
try:
    ends: np.ndarray = tri.segments.ends
    tri.segments.ends.append(3)  # wrong: an array
except deldrift.ConflictError as error:
    kind: deldrift.ConflictKind = error.kind
regular = deldrift.Regular([[0, 0], [1, 0], [0, 1]], [1, 2, 3])
shown: int = regular.move(weights=[3, 2, 1]).newly_shown
with regular.step() as weighted:
    heavy: np.ndarray = weighted.insert([[1.0, 1.0]], weights=[4.0])
hidden: np.ndarray = regular.copy().hidden_by_weight.vertices
mesh = deldrift.Mesh.from_triangle({"vertices": [[0, 0], [1, 0], [0, 1]], "segments": [[0, 1], [1, 2], [2, 0]]})
part: float = mesh.advance([[0, 0]], ids=[0])
mesh.labels.append(3)  # wrong: an array
tri.move(3, 4, 5)  # wrong: too many arguments
tri.timestamp + "a"  # wrong: an int
"""


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_a_program_is_checked_by_its_types(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    environment = dict(os.environ, MYPYPATH=str(PACKAGE.parent)) if "site-packages" not in str(PACKAGE) else None
    command = [sys.executable, "-m", "mypy", "--strict", "program.py"]
    result = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=environment)
    wrong = [number for number, line in enumerate(PROGRAM.splitlines(), 1) if "# wrong" in line]
    found = re.findall(r"^program.py:(\d+): error", result.stdout, re.M)
    assert list(map(int, found)) == wrong, result.stdout


def test_what_users_see_has_types():
    assert (PACKAGE / "py.typed").exists()


def public():
    for name in deldrift.__all__:
        thing = getattr(deldrift, name)
        yield name, thing
        if isinstance(thing, type) and not issubclass(thing, (Exception, tuple)) and name != "Report":
            for member in vars_of(thing):
                if not member.startswith("_"):
                    yield f"{name}.{member}", getattr(thing, member)


def vars_of(kind):
    return {name for base in kind.__mro__ if base.__module__.startswith("deldrift") for name in vars(base)}


@pytest.mark.parametrize("name, thing", [case for case in public() if callable(case[1])])
def test_docstrings_are_numpydoc(name, thing):
    docscrape = pytest.importorskip("numpydoc.docscrape", reason="numpydoc is not installed")
    import inspect

    if isinstance(thing, type) and name not in ("Delaunay", "Mesh"):
        assert thing.__doc__
        return
    parsed = docscrape.NumpyDocString(inspect.getdoc(thing))
    assert parsed["Summary"]
    given = [n for n in inspect.signature(thing).parameters if n not in ("self", "_kind")]
    told = [n.strip(" *") for parameter in parsed["Parameters"] for n in parameter.name.split(",")]
    assert told == given
