"""Runs: lists of points, instances, stopping, threads, lifetimes."""

import gc
import signal
import sys
import threading
import time

import nacre
import numpy
import pytest
from conftest import refused
from dlpack import DLPack

OUTPUTS = nacre.Entry.OUTPUTS
COUNT = 1000
UV = numpy.random.default_rng(2).random((COUNT, 2), "float32")
ENDLESS = 10**12  # Points, of which a run takes days.


def zeros(*shape):
    return numpy.zeros(shape, "float32")


def test_listed_points_are_shaded(twice):
    points = numpy.arange(0, COUNT, 3, dtype="uint32")
    out = zeros(COUNT, 2)
    binding = twice.bind({"uv0": UV, "out": out})
    assert binding.run(OUTPUTS, points=points)
    expected = zeros(COUNT, 2)
    expected[::3] = 2 * UV[::3]
    assert numpy.array_equal(out, expected)
    out[:] = 0
    binding.run(OUTPUTS, 2, points=points[::-1].copy())  # The first two of the list.
    assert numpy.flatnonzero(out[:, 0]).tolist() == sorted(points[-2:].tolist())


def test_of_place_is_as_long_as_the_list(twice):
    points = numpy.array([7, 3, 999], "uint32")
    out = zeros(3, 2)
    twice.bind({"uv0": UV, "out": nacre.of_place(out)}).run(OUTPUTS, points=points)
    assert numpy.array_equal(out, 2 * UV[points])


def test_more_than_one_stretch_of_points(twice):
    """A run of many is several of the library's, with a look at signals between them."""
    count = 2 * 65536 + 17
    uv = numpy.random.default_rng(3).random((count, 2), "float32")
    assert numpy.array_equal(twice.run({"uv0": uv})["out"], 2 * uv)
    points = numpy.random.default_rng(4).permutation(count).astype("uint32")
    out, placed = zeros(count, 2), zeros(count, 2)
    twice.bind({"uv0": uv, "out": out}).run(OUTPUTS, points=points)
    twice.bind({"uv0": uv, "out": nacre.of_place(placed)}).run(OUTPUTS, points=points)
    assert numpy.array_equal(out, 2 * uv)
    assert numpy.array_equal(placed, 2 * uv[points])
    table = numpy.arange(10, dtype="float32")
    instances = (numpy.arange(count) % 10).astype("uint32")
    of_table = twice.run({"uv0.x": nacre.of_instance(table), "uv0.y": 0}, instances=instances)
    assert numpy.array_equal(of_table["out"][:, 0], 2 * table[instances])


def test_instances_pick_elements(twice):
    table = numpy.array([[1, 2], [3, 4], [5, 6]], "float32")
    instances = numpy.random.default_rng(5).integers(0, 3, COUNT).astype("uint32")
    binding_arrays = {"uv0": nacre.of_instance(table)}
    assert numpy.array_equal(twice.run(binding_arrays, instances=instances)["out"],
                             2 * table[instances])
    points = numpy.array([5, 0, 17], "int32")
    out = twice.run(binding_arrays, points=points, instances=instances)["out"]
    assert numpy.array_equal(out[points], 2 * table[instances[points]])


@pytest.mark.parametrize("points, name, code", [
    (numpy.array([0, COUNT], "uint32"), "out", "short-array"),
    (numpy.array([-1], "int32"), "out", "short-array"),
    (numpy.array([0, 1], "int64"), "points", "bad-array"),
    (numpy.array([0, 1, 2, 3], "uint32")[::2], "points", "bad-array"),
    ([0, 1], "points", "bad-array"),
])
def test_lists_that_lead_outside_are_refused(twice, points, name, code):
    binding = twice.bind({"out": zeros(COUNT, 2), "uv0": (1, 1)})
    with refused(code, name):
        binding.run(OUTPUTS, points=points)


def test_counts_past_a_list_are_refused(twice):
    with refused("short-array", "points", "3 elements", "2"):
        twice.bind({"uv0": UV}).run(OUTPUTS, 3, points=numpy.zeros(2, "uint32"))
    with refused("short-array", "out", "3 elements", "2"):
        twice.bind({"uv0": UV, "out": nacre.of_place(zeros(2, 2))}).run(
            OUTPUTS, points=numpy.zeros(3, "uint32"))


def test_instances_that_lead_outside_are_refused(twice):
    binding = twice.bind({"uv0": nacre.of_instance(zeros(3, 2)), "out": zeros(4, 2)})
    binding.run(OUTPUTS, instances=numpy.array([0, 1, 2, 0], "uint32"))
    with refused("short-array", "uv0", "4 elements", "3"):
        binding.run(OUTPUTS, instances=numpy.array([0, 1, 2, 3], "uint32"))
    with refused("short-array", "instances", "4 elements", "3"):
        binding.run(OUTPUTS, instances=numpy.array([0, 1, 2], "uint32"))
    with refused("short-array", "instances", "4 elements", "0"):
        binding.run(OUTPUTS)


def test_entries_that_were_not_bound_are_refused(lambert):
    points = nacre.surface_points((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 1.0))
    binding = lambert.bind(points, entries=[nacre.Entry.ALBEDO])
    assert binding.run(nacre.Entry.ALBEDO, 1)
    with refused("unbound-entry", "entry"):
        binding.run(nacre.Entry.SAMPLE, 1)


def test_arrays_live_as_long_as_the_binding(twice):
    uv, out = UV.copy(), zeros(COUNT, 2)
    references = sys.getrefcount(uv), sys.getrefcount(out)
    binding = twice.bind({"uv0": uv, "out": out})
    view = out[:]
    del uv
    gc.collect()
    binding.run(OUTPUTS)
    assert numpy.array_equal(view, 2 * UV)
    del view, binding
    assert sys.getrefcount(out) == references[1]


@pytest.mark.parametrize("wrap", [lambda a: a, lambda a: DLPack(a)], ids=["buffer", "dlpack"])
def test_arrays_are_let_go(twice, wrap):
    out = zeros(COUNT, 2)
    before = sys.getrefcount(out)
    for _ in range(100):
        twice.bind({"uv0": UV, "out": wrap(out)}).run(OUTPUTS)
        with pytest.raises(nacre.Error):  # What was bound before the fault, too.
            twice.bind({"out": wrap(out), "uv0": numpy.zeros(3)})
    gc.collect()
    assert sys.getrefcount(out) == before


def test_memory_that_is_bound_cannot_be_resized(twice):
    memory = bytearray(8 * COUNT)
    binding = twice.bind({"uv0": UV, "out": memoryview(memory).cast("f", (COUNT, 2))})
    with pytest.raises(BufferError):
        memory.extend(b"more")
    del binding
    memory.extend(b"more")


def test_objects_outlive_what_they_were_made_of(documents):
    def bound():
        shader = nacre.System().compile_outputs(
            nacre.Document.parse(documents["twice"]), ["out"])
        return shader.bind({"uv0": UV.copy(), "out": out})

    out = zeros(COUNT, 2)
    binding = bound()
    gc.collect()
    binding.run(OUTPUTS)
    assert numpy.array_equal(out, 2 * UV)


@pytest.fixture(scope="module")
def slow(system, documents):
    shader = system.compile_outputs(nacre.Document.parse(documents["slow"]), ["out"],
                                    no_footprints=True)
    return shader.bind({each.name: 0.5 for each in shader.inputs(OUTPUTS)})


def test_a_stop_ends_a_run_and_other_threads_run_meanwhile(slow):
    """This thread goes on only if the other one's run has let go of the interpreter."""
    stop, ended, began = nacre.Stop(), [], threading.Event()

    def shade():
        began.set()
        ended.append(slow.run(OUTPUTS, ENDLESS, stop=stop))

    thread = threading.Thread(target=shade, daemon=True)
    thread.start()
    assert began.wait(60)
    time.sleep(0.05)
    assert thread.is_alive()
    stop.set()
    thread.join(60)
    assert ended == [False]
    assert stop.is_set()
    assert not slow.run(OUTPUTS, 1, stop=stop)
    stop.clear()
    assert slow.run(OUTPUTS, 1, stop=stop)


def test_compiling_lets_other_threads_run(documents):
    """Threads that compile with one system, with documents that they read themselves."""
    system = nacre.System()
    results = {}

    def work(number):
        text = documents["twice"].replace('value="2"', f'value="{number}"')
        shader = system.compile_outputs(nacre.Document.parse(text), ["out"])
        results[number] = shader.run({"uv0": UV})["out"]

    threads = [threading.Thread(target=work, args=(number,)) for number in range(2, 6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert sorted(results) == [2, 3, 4, 5]
    for number, out in results.items():
        assert numpy.array_equal(out, numpy.float32(number) * UV)


def test_threads_share_a_binding(twice):
    out = zeros(COUNT, 2)
    binding = twice.bind({"uv0": UV, "out": out})
    parts = [numpy.arange(first, COUNT, 4, dtype="uint32") for first in range(4)]
    threads = [threading.Thread(target=binding.run, args=(OUTPUTS,), kwargs={"points": part})
               for part in parts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert numpy.array_equal(out, 2 * UV)


def test_a_signal_ends_a_run(slow):
    class Alarm(Exception):
        pass

    def ring(number, frame):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(Alarm):
            slow.run(OUTPUTS, ENDLESS)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
