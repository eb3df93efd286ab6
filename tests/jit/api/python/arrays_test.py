"""Arrays of every kind and layout, none of which is copied."""

import array
import ctypes

import nacre
import numpy
import pytest
from conftest import refused
from dlpack import DLPack

COUNT = 100
UV = numpy.random.default_rng(1).random((COUNT, 2), "float32")


def run(twice, uv, out, **arguments):
    assert twice.bind({"uv0": uv, "out": out}).run(nacre.Entry.OUTPUTS, **arguments)
    return out


class OnDevice(DLPack):
    """DLPack that says of its memory that it is CUDA's."""

    def __dlpack__(self, **arguments):
        capsule = self.of.__dlpack__()
        get = ctypes.pythonapi.PyCapsule_GetPointer
        get.restype, get.argtypes = ctypes.c_void_p, (ctypes.py_object, ctypes.c_char_p)
        tensor = get(capsule, b"dltensor")  # void* data, then the device.
        ctypes.cast(tensor + ctypes.sizeof(ctypes.c_void_p), ctypes.POINTER(ctypes.c_int))[0] = 2
        return capsule

    def __dlpack_device__(self):
        return (2, 0)


def structured():
    points = numpy.zeros(COUNT, [("P", "f4", 3), ("uv", "f4", 2)])
    points["uv"] = UV
    return points


LAYOUTS = {
    "rows": UV,
    "columns": numpy.asfortranarray(UV),
    "transposed": numpy.ascontiguousarray(UV.T).T,
    "every other": numpy.repeat(UV, 2, axis=0)[::2],
    "backwards": UV[::-1].copy()[::-1],
    "structures": structured()["uv"],
    "part of more components": numpy.hstack([UV, UV])[:, 2:],
    "memoryview": memoryview(UV),
    "dlpack": DLPack(UV),
    "dlpack, strided": DLPack(numpy.asfortranarray(UV)),
    "pixels": UV.reshape(10, 10, 2),
}


@pytest.mark.parametrize("uv", LAYOUTS.values(), ids=LAYOUTS.keys())
def test_layouts_are_read(twice, uv):
    out = numpy.full((COUNT, 2), -1, "float32")
    run(twice, uv, out)
    assert numpy.array_equal(out, 2 * UV)


@pytest.mark.parametrize("make", [
    lambda: numpy.zeros((COUNT, 2), "float32"),
    lambda: numpy.zeros((COUNT, 2), "float32", order="F"),
    lambda: numpy.zeros((COUNT, 5), "float32")[:, 1:3],
    lambda: numpy.zeros((2 * COUNT, 2), "float32")[::2],
    lambda: structured()["uv"],
    lambda: numpy.zeros((4, 25, 2), "float32"),
], ids=["rows", "columns", "part", "every other", "structures", "pixels"])
def test_layouts_are_written(twice, make):
    out = make()
    run(twice, UV, out)
    assert numpy.array_equal(out.reshape(COUNT, 2), 2 * UV)


def test_only_what_is_bound_is_written(twice):
    wide = numpy.full((COUNT, 4), -1, "float32")
    run(twice, UV, wide[:, 1:3], count=COUNT // 2)
    assert numpy.array_equal(wide[: COUNT // 2, 1:3], 2 * UV[: COUNT // 2])
    assert (wide[:, 0] == -1).all() and (wide[:, 3] == -1).all()
    assert (wide[COUNT // 2 :] == -1).all()


def test_results_through_dlpack(twice):
    out = numpy.zeros((COUNT, 2), "float32")
    run(twice, UV, DLPack(out))
    assert numpy.array_equal(out, 2 * UV)


def test_pythons_own_arrays(twice):
    u, v = array.array("f", [1, 2, 3]), (ctypes.c_float * 3)(4, 5, 6)
    x, y = array.array("f", [0] * 3), bytearray(12)
    twice.bind({"uv0.x": u, "uv0.y": v, "out.x": x,
                "out.y": memoryview(y).cast("f")}).run(nacre.Entry.OUTPUTS)
    assert x.tolist() == [2, 4, 6]
    assert memoryview(y).cast("f").tolist() == [8, 10, 12]


def test_one_element_is_that_of_all_points(twice):
    for uv in (0.25, 0.5), [0.25, 0.5], numpy.array([0.25, 0.5], "float32"), \
            numpy.broadcast_to(numpy.array([0.25, 0.5], "float32"), (COUNT, 2)):
        assert (run(twice, uv, numpy.zeros((COUNT, 2), "float32")) == [0.5, 1.0]).all()
    uv = {"uv0.x": numpy.float64(1), "uv0.y": numpy.array(2, "float32")}
    assert twice.run(uv, count=2)["out"].tolist() == [[2, 4], [2, 4]]


def test_integers_are_channels_too(system, documents):
    document = nacre.Document.parse(documents["values"])
    shader = system.compile_outputs(document, ["number"], live=["*"], varying=["count/value"])
    assert shader.inputs(nacre.Entry.OUTPUTS)[0].dtype == "int32"
    for dtype in "int32", "uint32":
        numbers = numpy.array([1, 2**31 - 1, 3], dtype)
        assert shader.run({"count/value": numbers})["number"].tolist() == numbers.tolist()
    assert shader.run({"count/value": 5}, count=1)["number"].tolist() == [5]
    with refused("bad-array", "count/value", "int32", "float32 (3,)"):
        shader.run({"count/value": numpy.zeros(3, "float32")})
    with refused("bad-array", "count/value", "int32", "1.5"):
        shader.run({"count/value": 1.5}, count=1)


def test_nothing_is_copied(twice):
    uv, out = UV.copy(), numpy.zeros((COUNT, 2), "float32")
    before = out.ctypes.data
    binding = twice.bind({"uv0": uv, "out": out})
    for factor in 1, 3:  # What changes in the arrays is seen without binding again.
        uv[:] = factor * UV
        binding.run(nacre.Entry.OUTPUTS)
        assert numpy.array_equal(out, 2 * uv)
    assert out.ctypes.data == before
    # The results are those of the caller, and of its memory.
    assert twice.run({"uv0": uv, "out": out})["out"] is out


def writable(value=0.0, dtype="float32", shape=(COUNT, 2)):
    return numpy.full(shape, value, dtype)


def unaligned():
    return numpy.zeros(COUNT, [("pad", "u1"), ("uv", "f4", 2)])["uv"]


@pytest.mark.parametrize("name, value, expected, found", [
    ("uv0", writable(dtype="float64"), "float32", "float64 (100, 2)"),
    ("uv0", writable(dtype="int32"), "float32", "int32 (100, 2)"),
    ("uv0", writable(dtype=">f4"), "float32", ">f (100, 2)"),
    ("uv0", writable(shape=(COUNT, 3)), "(count, 2)", "float32 (100, 3)"),
    ("uv0", writable(shape=(COUNT,)), "(count, 2)", "float32 (100,)"),
    ("uv0.x", numpy.broadcast_to(writable(shape=(10, 1)), (10, 10)), "one stride", "(10, 10)"),
    ("uv0", writable(shape=(10, 20, 2))[:, :10], "one stride", "float32 (10, 10, 2)"),
    ("uv0", unaligned(), "4 bytes", "float32"),
    ("uv0", OnDevice(writable()), "cpu", "on cuda"),
    ("uv0", "red", "buffer protocol or DLPack", "str"),
    ("uv0", None, "buffer protocol or DLPack", "NoneType"),
    ("uv0", (1, 2, 3), "2", "3 numbers"),
    ("uv0", ("a", "b"), "a tuple of numbers", "tuple"),
    ("out", numpy.broadcast_to(writable(shape=(2,)), (COUNT, 2)), "can be written", "read-only"),
    ("out", bytes(8), "float32", "uint8 (8,)"),
    ("out", (1, 2), "an array", "2 numbers"),
    ("out", DLPack(writable(dtype="float64")), "float32", "float64 (100, 2)"),
])
def test_arrays_that_do_not_fit_are_refused(twice, name, value, expected, found):
    with refused("bad-array", name, f"'{name}'", expected, found):
        twice.bind({"uv0": UV, "out": writable()} | {name: value})


def test_results_need_an_element_a_point(twice):
    with pytest.raises(nacre.Error, match="out"):
        twice.bind({"uv0": UV, "out": numpy.zeros(2, "float32")})


def test_names_that_nobody_has_are_refused(twice):
    with refused("unknown-channel", "uv", "out.x", "did you mean 'uv0'?"):
        twice.bind({"uv": UV})
    with refused("unknown-channel", "Out", "out.x", "did you mean 'out'?"):
        twice.bind({"uv0": UV, "Out": writable()})
    with pytest.raises(nacre.Error) as far:
        twice.bind({"uv0": UV, "elephant": writable()})
    assert "did you mean" not in str(far.value)
    # Those of other shaders are no mistake.
    twice.bind({"uv0": UV, "P": writable(shape=(COUNT, 3)), "geomprop.age": 1, "wi": (0, 0, 1)})


def test_inputs_without_an_array_are_said(twice):
    with pytest.raises(nacre.Error) as caught:
        twice.bind({"out": writable()})
    assert [each.code for each in caught.value.diagnostics] == ["unbound-channel"] * 2
    assert "uv0.x" in str(caught.value)


def test_arrays_that_are_too_short_are_refused(twice):
    binding = twice.bind({"uv0": UV, "out": writable(shape=(COUNT - 1, 2))})
    assert binding.count(nacre.Entry.OUTPUTS) == COUNT - 1
    assert binding.run(nacre.Entry.OUTPUTS)
    with refused("short-array", "out", "100 elements", "99"):
        binding.run(nacre.Entry.OUTPUTS, COUNT)
    with refused("no-count", "count"):
        twice.bind({"uv0": (0, 0)}).run(nacre.Entry.OUTPUTS)
    with pytest.raises(TypeError):
        binding.run(nacre.Entry.OUTPUTS, -1)


def test_what_reads_no_point_is_stored_for_each(system):
    """Silently there were none."""
    constant = system.compile_outputs(nacre.Document.parse(
        """<materialx version="1.39"><constant name="three" type="float">
           <input name="value" type="float" value="3"/></constant>
           <output name="out" type="float" nodename="three"/></materialx>"""), ["out"])
    assert constant.run({"uv0": UV})["out"].tolist() == [3.0] * COUNT
    assert constant.run({}, count=2)["out"].tolist() == [3.0] * 2
    with refused("no-count", "count"):
        constant.run({"uv0": (0, 0)})


def test_no_points_are_no_work(twice):
    assert twice.run({"uv0": numpy.zeros((0, 2), "float32")})["out"].shape == (0, 2)
    assert twice.bind({"uv0": UV}).run(nacre.Entry.OUTPUTS, 0)
