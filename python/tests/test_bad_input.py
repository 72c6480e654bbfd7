"""Wrong calls: each has an exception, as the table says, and changes nothing."""

import inspect

import numpy as np
import pytest

import bad_input
import deldrift


def state(made):
    """What can be asked about all that `bad_input.make` has made."""
    triangulations = [one.delaunay if isinstance(one, deldrift.Mesh) else one for one in made.values()]
    return [(tri.tobytes(), tri.algorithm, tri.statistics.as_dict()) for tri in triangulations]


@pytest.mark.parametrize("text", bad_input.CALLS)
def test_nothing_is_changed(text):
    made = bad_input.make()
    before = state(made)
    error = bad_input.call(text, made)
    assert isinstance(error, (deldrift.Error, TypeError, ValueError))
    assert not isinstance(error, deldrift.InternalError)
    assert state(made) == before


def test_the_page_is_that_of_the_calls():
    if np.lib.NumpyVersion(np.__version__) < "2.0.0":
        pytest.skip("the page is written with NumPy 2")
    if not bad_input.PAGE.exists():
        pytest.skip("the page is in the sources alone")
    assert bad_input.PAGE.read_text() == bad_input.page()


def has_arguments(function):
    parameters = list(inspect.signature(function).parameters)
    return bool([name for name in parameters if name != "self"])


def test_every_function_is_in_the_table():
    text = "\n".join(bad_input.CALLS)
    functions = [name for name in deldrift.__all__ if inspect.isfunction(getattr(deldrift, name))]
    assert [name for name in functions if has_arguments(getattr(deldrift, name)) and f"{name}(" not in text] == []
    methods = inspect.getmembers(deldrift.Delaunay, inspect.isfunction)
    missing = [n for n, f in methods if n[0] != "_" and has_arguments(f) and f"tri.{n}(" not in text]
    # Those without an error in the plane are called in space, and on what has segments.
    missing = [name for name in missing if f"space.{name}(" not in text and f"bound.{name}(" not in text]
    assert missing == []
    methods = [(n, f) for n, f in vars(deldrift.Regular).items() if inspect.isfunction(f)]
    assert [n for n, f in methods if n[0] != "_" and has_arguments(f) and f"regular.{n}(" not in text] == []
    methods = inspect.getmembers(deldrift.Mesh, inspect.isroutine)
    missing = [n for n, f in methods if n[0] != "_" and has_arguments(f) and f"mesh.{n}(" not in text.lower()]
    assert missing == []
    for name in "move", "insert", "remove", "add_segments", "remove_segments", "check":
        assert f"step.{name}(" in text or f"step().{name}(" in text


def test_errors_can_be_pickled_and_have_their_place():
    import pickle

    error = bad_input.call("Delaunay([[0, 0], [1, 2e57]])", bad_input.make())
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is deldrift.OutOfRange and str(again) == str(error)
    assert (again.argument, again.index, again.value) == ("points", 1, 2e57)
