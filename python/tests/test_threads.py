"""Callbacks, and several threads: on several triangulations, and on one."""

import pickle
import threading
import time

import numpy as np
import pytest

import deldrift


@pytest.fixture
def many(rng, ndim):
    return rng.random((30_000, ndim))


def test_progress(many):
    told = []
    deldrift.Delaunay(many, progress=told.append, threads=1)
    assert told and all(0 <= part <= 1 for part in told)


class Bar:
    """What tqdm has of what is used."""

    def __init__(self, total=None, unit=""):
        self.total, self.n, self.updates = total, 0, 0

    def update(self, by):
        self.n += by
        self.updates += 1


def test_progress_of_bars(many):
    bar = Bar(total=100)
    deldrift.Delaunay(many, progress=bar)
    assert bar.updates and 0 <= bar.n <= 100
    deldrift.Delaunay(many, progress=Bar)
    tqdm = pytest.importorskip("tqdm", reason="tqdm is not installed")
    deldrift.Delaunay(many, progress=tqdm.tqdm)
    with pytest.raises(TypeError, match="progress is 3"):
        deldrift.Delaunay(many, progress=3)


def test_cancel(many):
    with pytest.raises(deldrift.Cancelled):
        deldrift.Delaunay(many, cancel=lambda: True)
    is_wanted = [False]
    tri = deldrift.Delaunay(many, cancel=lambda: is_wanted[0], algorithm="rebuilding")
    before = tri.simplices.copy()
    is_wanted[0] = True
    with pytest.raises(deldrift.Cancelled):
        tri.move(many[::-1])
    np.testing.assert_array_equal(tri.simplices, before)
    is_wanted[0] = False
    tri.move(many[::-1])
    np.testing.assert_array_equal(tri.points, many[::-1])


@pytest.mark.parametrize("kind", [KeyboardInterrupt, ZeroDivisionError])
def test_exceptions_of_callbacks_come_out(many, kind):
    def fail(*_):
        raise kind("stop")

    with pytest.raises(kind, match="stop"):
        deldrift.Delaunay(many, progress=fail)
    with pytest.raises(kind, match="stop"):
        deldrift.Delaunay(many, cancel=fail)


def test_a_callback_that_uses_its_triangulation_is_turned_away(many):
    found = []

    def use(_part):
        if found or tri is None:
            return
        for call in (lambda: tri.simplices, lambda: tri.move(many)):
            with pytest.raises(deldrift.Busy):
                call()
        found.append(True)

    tri = None
    tri = deldrift.Delaunay(many, progress=use, algorithm="rebuilding")
    tri.move(many[::-1])
    assert found
    tri.move(many)


def test_several_threads_on_several_triangulations(many):
    many = many[:5000]
    expected = deldrift.Delaunay(many, threads=1).simplices
    results = [None] * 4

    def work(k):
        tri = deldrift.Delaunay(many, threads=1)
        tri.move(many[::-1])
        tri.move(many)
        results[k] = tri

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for tri in results:
        assert set(map(frozenset, tri.simplices.tolist())) == set(map(frozenset, expected.tolist()))


def test_parts_give_one_order(many):
    few = many[:20_000]
    one, several = (deldrift.Delaunay(few, threads=threads, parts=3) for threads in (1, 2))
    for tri in (several, several.copy(), pickle.loads(pickle.dumps(several))):
        np.testing.assert_array_equal(tri.simplices, one.simplices)
        assert tri._division == (2, 3)


def test_the_gil_is_released(rng):
    """A thread of Python goes on while another one is in a long call."""
    points = rng.random((200_000, 3))
    counts, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counts[0] += 1
            time.sleep(1e-4)

    thread = threading.Thread(target=count)
    thread.start()
    before = counts[0]
    deldrift.Delaunay(points, threads=1)
    counted = counts[0] - before
    done.set()
    thread.join()
    assert counted > 20


def test_two_threads_on_one_triangulation_get_an_exception(rng):
    """Whatever two threads do, each call works or raises Busy, and in the end the triangulation is right."""
    points = rng.random((20_000, 2))
    tri = deldrift.Delaunay(points)
    outcomes = {"done": 0, "busy": 0}
    lock = threading.Lock()

    def work(seed):
        rng = np.random.default_rng(seed)
        for _ in range(60):
            try:
                kind = rng.integers(4)
                if kind == 0:
                    tri.move(points + 1e-4 * rng.standard_normal(points.shape))
                elif kind == 1:
                    simplices = tri.simplices
                    assert simplices.max() < len(points)
                elif kind == 2:
                    tri.volumes()
                else:
                    tri.relocate(int(rng.integers(len(points))), rng.random(2))
                outcome = "done"
            except deldrift.Busy:
                outcome = "busy"
            with lock:
                outcomes[outcome] += 1

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert outcomes["done"] + outcomes["busy"] == 240 and outcomes["done"] > 0 and outcomes["busy"] > 0
    tri.validate()
    fresh = deldrift.Delaunay(tri.points)
    assert set(map(frozenset, tri.simplices.tolist())) == set(map(frozenset, fresh.simplices.tolist()))


def test_several_threads_may_read_one_triangulation(rng):
    tri = deldrift.Delaunay(rng.random((20_000, 2)))
    expected, failures = tri.volumes(), []

    def read():
        for _ in range(20):
            if not np.array_equal(tri.volumes(), expected) or tri.find_simplex([0.5, 0.5]) < 0:
                failures.append(True)

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
