"""Signals during long calls, the ends of blocks, and what comes of both."""

import gc
import inspect
import os
import pathlib
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import deldrift
import signals

TESTS = pathlib.Path(__file__).resolve().parent


class Stop(Exception):
    """What the handler raises."""


@pytest.fixture
def handler():
    """Has SIGUSR1 raise."""

    def stop(*_):
        raise Stop

    before = signal.signal(signal.SIGUSR1, stop)
    yield
    signal.signal(signal.SIGUSR1, before)


def send():
    os.kill(os.getpid(), signal.SIGUSR1)


@pytest.mark.parametrize("kind", list(signals.CALLBACKS))
def test_signals_at_random_times(kind):
    """A process of its own, as a crash would end it. `python signals.py` does more."""
    script = f"import signals; signals.main(3, kinds=[{kind!r}])"
    package = str(pathlib.Path(deldrift.__file__).resolve().parent.parent)
    environment = dict(os.environ, PYTHONPATH=package)
    command = [sys.executable, "-c", script]
    result = subprocess.run(command, cwd=TESTS, env=environment, capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stdout[-2000:] + result.stderr[-5000:]
    if signals.IS_EXACT:
        assert "Exception ignored" not in result.stderr and result.stdout.rstrip().endswith(", 0 lost, 0 in part")


def test_signals_from_another_thread_come_out(handler, rng):
    tri = deldrift.Delaunay(rng.random((20_000, 3)), cancel=lambda: False, algorithm="rebuilding", threads=1)
    before = tri.points
    for wait in np.linspace(0.0005, 0.01, 12):
        timer = threading.Timer(wait, send)
        with pytest.raises(Stop):
            timer.start()
            # Far more than can be made until then: without an exception it has been lost.
            for _ in range(300):
                tri.move(before[::-1] if (tri.points == before).all() else before)
        timer.join()
        assert (tri.points == before).all() or (tri.points == before[::-1]).all()
    tri.validate()


def test_ctrl_c_without_callbacks_is_answered_at_the_end_of_the_call(rng):
    """As the page says: the call is made then."""
    points = rng.random((20_000, 3))
    tri = deldrift.Delaunay(points, algorithm="rebuilding", threads=1)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        for part in 0.2, 0.5, 0.8:
            goal = points + part * 1e-3
            timer = threading.Timer(0.005, os.kill, (os.getpid(), signal.SIGINT))
            timestamp, before_move = tri.timestamp, tri.points
            with pytest.raises(KeyboardInterrupt):
                timer.start()
                tri.move(goal)
                timer.join()
                for _ in range(1000):
                    deldrift.orientation(goal[:4])
            timer.join()
            # It may have come before the library was called.
            is_made = tri.timestamp == timestamp + 1
            assert is_made or tri.timestamp == timestamp
            assert (tri.points == (goal if is_made else before_move)).all()
            tri.validate()
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_exception_of_is_too_large_ends_the_call_at_once(handler):
    square = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]]
    mesh, asked = deldrift.Mesh(*square), []

    def ask(rows):
        assert rows.shape == (3, 2)
        asked.append(True)
        if len(asked) == 5:
            send()
        return len(asked) < 50

    with pytest.raises(Stop):
        mesh.refine(is_too_large=ask)
    assert len(asked) == 5 and len(mesh.points) == 4
    assert mesh.refine(is_too_large=lambda rows: np.ptp(rows[:, 0]) > 0.3).inserted > 0


def test_callbacks_may_call_copies_that_have_the_same_ones(rng):
    """One function of C's for both: each question has a generator of its own."""
    points = rng.random((20_000, 2))
    copy, moved, depth = None, [], [0]

    def tell(_part):
        depth[0] += 1
        if copy is not None and depth[0] < 4:
            moved.append(copy[0].move(points[::-1] if len(moved) % 2 else points))
        depth[0] -= 1

    tri = deldrift.Delaunay(points, progress=tell, algorithm="rebuilding")
    first = tri.copy()
    copy = [first]
    with pytest.raises(deldrift.Busy):
        # The copy calls back as well, and that asks it to move while it does.
        tri.move(points[::-1])
    copy = None
    tri.move(points[::-1])
    first.move(points)
    tri.validate()


def test_many_threads_read_one_triangulation_with_callbacks(rng):
    told = []
    tri = deldrift.Delaunay(rng.random((5000, 2)), progress=told.append, cancel=lambda: False)
    box = [0, 0], [1, 1]
    expected, failures = tri.voronoi_volumes(box), []

    def read():
        for _ in range(5):
            if not np.array_equal(tri.voronoi_volumes(box), expected):
                failures.append(True)

    threads = [threading.Thread(target=read) for _ in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures and told


@pytest.mark.skipif(sys.implementation.name != "cpython", reason="memory is freed later where references are not counted")
def test_what_a_call_has_made_is_freed_where_a_handler_raises(handler, rng):
    """A triangulation that nobody has got, and callbacks: without a collection of circles."""
    resource = pytest.importorskip("resource")
    points = rng.random((100_000, 2))

    def interrupted(**options):
        timer = threading.Timer(0.002, send)
        with pytest.raises(Stop):
            timer.start()
            deldrift.Delaunay(points, threads=1, **options)
            timer.join()
            for _ in range(1000):
                deldrift.orientation(points[:3])
        timer.join()

    gc.disable()
    try:
        for _ in range(3):
            interrupted()
            interrupted(cancel=lambda: False)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(10):
            interrupted()
            interrupted(cancel=lambda: False)
        # One of them has some 20,000 KiB.
        assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 60_000
    finally:
        gc.enable()


class Reader:
    """A call in another thread that reads until it is let go."""

    def __init__(self, tri):
        self.entered, self.let_go = threading.Event(), threading.Event()
        self.thread = threading.Thread(target=self.read, args=(tri,))
        self.thread.start()
        assert self.entered.wait(30)

    def read(self, tri):
        with tri._reading:
            self.entered.set()
            self.let_go.wait(30)

    def end(self):
        self.let_go.set()
        self.thread.join()


def is_at_rest(tri, points, timestamp):
    """Whether it is as before, and takes every kind of call."""
    assert (tri.points == points).all() and tri.timestamp == timestamp
    saved = tri.tobytes()
    assert tri.copy().tobytes() == saved
    tri.validate()
    tri.move(points + 0.25)
    assert tri.timestamp == timestamp + 1
    tri.insert([[0.5, 0.5]] if tri.is_periodic else [0.5, 0.5])
    with tri.trial():
        tri.move(np.array(tri.points) + 0.125)
    with tri.trial() as trial:
        tri.move(np.array(tri.points) + 0.125)
        trial.withdraw()
    tri.compact()
    tri.validate()
    return True


@pytest.fixture(params=["open", "periodic"])
def tri(request, rng):
    # On the grid of a box, so that positions are told as they were given.
    points = rng.integers(0, 1 << 20, (200, 2)) / (1 << 20)
    return deldrift.PeriodicDelaunay(points, [1, 1]) if request.param == "periodic" else deldrift.Delaunay(points)


def test_the_end_of_a_trial_meets_a_reader(tri):
    points = tri.points
    with pytest.raises(deldrift.Busy):
        with tri.trial():
            tri.move(points + 0.5)
            reader = Reader(tri)
    # The trial is taken back as soon as the reader has ended; nobody sees it until then.
    for call in (lambda: tri.points, lambda: tri.move(points), lambda: tri.trial().__enter__(), tri.tobytes):
        with pytest.raises(deldrift.Busy):
            call()
    reader.end()
    assert is_at_rest(tri, points, 0)


def test_an_exception_in_a_trial_meets_a_reader(tri):
    points = tri.points
    with pytest.raises(ZeroDivisionError):
        with tri.trial():
            tri.move(points + 0.5)
            reader = Reader(tri)
            raise ZeroDivisionError
    reader.end()
    assert is_at_rest(tri, points, 0)


def test_withdrawing_meets_a_reader(tri):
    points = tri.points
    with tri.trial() as trial:
        tri.move(points + 0.5)
        reader = Reader(tri)
        with pytest.raises(deldrift.Busy):
            trial.withdraw()
        reader.end()
        trial.withdraw()
    assert is_at_rest(tri, points, 0)


def test_a_trial_is_not_closed(rng):
    points = rng.random((50, 2))
    tri = deldrift.Delaunay(points)
    with tri.trial():
        tri.move(points[::-1])
        with pytest.raises(deldrift.Busy):
            tri.close()
    assert tri.timestamp == 1
    tri.close()
    with pytest.raises(deldrift.Closed):
        tri.move(points)


def test_the_end_of_a_step_meets_a_reader(rng):
    points = rng.random((50, 2))
    tri = deldrift.Delaunay(points)
    saved = tri.tobytes()
    for is_good in True, False:
        with pytest.raises(deldrift.Busy if is_good else ZeroDivisionError):
            with tri.step() as step:
                step.move(points[::-1])
                step.insert([[2, 2]])
                reader = Reader(tri)
                if not is_good:
                    raise ZeroDivisionError
        with pytest.raises(deldrift.Busy):
            tri.points
        reader.end()
        assert tri.tobytes() == saved
        assert is_at_rest(tri.copy(), points, 0)


@pytest.mark.parametrize("kind", ["step", "trial"])
@pytest.mark.parametrize("is_good", [True, False])
def test_a_signal_at_the_end_of_a_block(handler, rng, kind, is_good):
    """Raised wherever Python looks for signals while the block ends: all or nothing, and nothing stays open."""
    points = rng.random((50, 2))
    is_made = set()
    for place in range(60):
        tri = deldrift.Delaunay(points)
        seen = [0]

        def profile(frame, event, _argument):
            # Python looks for signals where a function begins, and where one of C's has returned.
            is_looking = event == "c_return" or (event == "call" and not frame.f_code.co_flags & inspect.CO_GENERATOR)
            if is_looking and "deldrift" in frame.f_code.co_filename and ending:
                seen[0] += 1
                if seen[0] == place:
                    sys.setprofile(None)
                    send()

        ending = False
        try:
            sys.setprofile(profile)
            with getattr(tri, kind)() as block:
                (block if kind == "step" else tri).move(points[::-1])
                ending = True
                if not is_good:
                    raise ZeroDivisionError
        except (Stop, ZeroDivisionError):
            pass
        finally:
            sys.setprofile(None)
        now = tri.points
        is_made.add(bool((now == points[::-1]).all()))
        assert (now == points).all() or (is_good and (now == points[::-1]).all())
        assert is_at_rest(tri, now, tri.timestamp)
    assert is_made == ({True, False} if is_good else {False})


def test_every_error_at_the_end_of_a_trial(rng, monkeypatch):
    """Whatever the publication raises, nothing stays prepared."""
    import deldrift._step as module

    points = rng.random((50, 2))
    publish = module._publish_timestamp
    for status in [2, 17, 18, 20, 21, 22, 36]:
        for is_made in True, False:
            tri = deldrift.Delaunay(points)
            monkeypatch.setattr(module, "_publish_timestamp", lambda t: (publish(t) if is_made else 0) or status)
            with pytest.raises(deldrift.Error):
                with tri.trial():
                    tri.move(points[::-1])
            monkeypatch.setattr(module, "_publish_timestamp", publish)
            assert is_at_rest(tri, points[::-1] if is_made else points, int(is_made))
