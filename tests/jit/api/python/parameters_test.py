"""Parameters as mappings, and instances."""

import nacre
import numpy
import pytest
from conftest import refused


@pytest.fixture(scope="module")
def shader(system, documents):
    document = nacre.Document.parse(documents["values"])
    return system.compile_outputs(document, ["out", "number"], live=["*"])


def out(shader, instance):
    results = shader.run({}, count=1, instance=instance)
    return float(results["out"][0]), int(results["number"][0])


def test_are_the_documents_values(shader):
    assert isinstance(shader.parameters, nacre.Parameters)
    assert shader.parameters["scale/value"] == 3.0
    assert shader.parameters["offset/value"] == (1.0, 2.0, 4.0)
    assert shader.parameters["flag/value"] is True
    assert shader.parameters["count/value"] == 7
    assert "nothing" not in shader.parameters
    assert len(shader.parameters) == len(list(shader.parameters))
    assert dict(shader.parameters.items())["scale/value"] == 3.0


def test_ui_is_what_the_document_says(shader):
    ui = shader.parameters.ui["scale/value"]
    assert (ui.label, ui.folder, ui.doc) == ("Scale", "Numbers", "How much")
    assert (ui.type, ui.components, ui.is_varying) == ("float", 1, False)
    assert (ui.minimum, ui.maximum, ui.value) == (0.0, 10.0, 3.0)
    assert shader.parameters.ui["count/value"].minimum is None


def test_instances_begin_with_the_documents_values(shader):
    instance = shader.instance()
    assert dict(instance.items()) == dict(shader.parameters)
    assert out(shader, instance) == (4.0, 7)
    assert out(shader, None) == (4.0, 7)


def test_instances_are_set_by_name(shader):
    instance = shader.instance({"scale/value": 10})
    assert out(shader, instance) == (11.0, 7)
    instance["offset/value"] = 5, 0, 0
    assert instance["offset/value"] == (5.0, 0.0, 0.0)
    assert out(shader, instance) == (15.0, 7)
    instance["offset/value"] = numpy.array([7, 0, 0], "float64")
    assert out(shader, instance) == (17.0, 7)
    instance["flag/value"] = False
    instance["count/value"] = -(2**31)
    assert instance["flag/value"] is False
    assert out(shader, instance) == (0.0, -(2**31))
    assert out(shader, shader.instance()) == (4.0, 7)  # Another one's are its own.


def test_integers_keep_all_their_bits(shader):
    instance = shader.instance({"count/value": 2**24 + 1})
    assert out(shader, instance)[1] == 2**24 + 1


@pytest.mark.parametrize("name, value, expected", [
    ("offset/value", 1.0, "color3"),
    ("offset/value", (1, 2), "3 real numbers"),
    ("scale/value", (1, 2, 3), "float"),
    ("scale/value", "red", "1 real numbers"),
    ("flag/value", 1, "booleans"),
    ("count/value", 1.5, "whole numbers"),
    ("count/value", 2**31, "32 bits"),
])
def test_values_that_do_not_fit_are_refused(shader, name, value, expected):
    instance = shader.instance()
    with refused("bad-parameter", name, expected, repr(value)):
        instance[name] = value
    assert instance[name] == shader.parameters[name]


def test_names_that_there_are_not_are_key_errors(shader):
    with pytest.raises(KeyError, match="scale/value"):
        shader.instance()["nothing"]
    with pytest.raises(KeyError):
        shader.instance({"nothing": 1})


def test_what_is_folded_is_no_parameter(system, documents):
    document = nacre.Document.parse(documents["values"])
    shader = system.compile_outputs(document, ["out"], live=["scale/*"])
    assert list(shader.parameters) == ["scale/value"]


def test_an_instance_of_another_shader_is_refused(shader, twice):
    with pytest.raises(nacre.Error, match="wrong arguments"):
        twice.run({"uv0": (0, 0)}, count=1, instance=shader.instance())


def test_varying_parameters_come_with_points(system, documents):
    document = nacre.Document.parse(documents["values"])
    shader = system.compile_outputs(document, ["out"], live=["*"],
                                    varying=["scale/value", "offset/value"])
    assert shader.parameters.ui["scale/value"].is_varying
    assert "scale/value" not in shader.instance()
    with pytest.raises(KeyError, match="comes with each point"):
        shader.instance()["scale/value"] = 1
    scale = numpy.arange(5, dtype="float32")
    offset = numpy.full((5, 3), 100, "float32")
    results = shader.run({"scale/value": scale, "offset/value": offset})
    assert results["out"].tolist() == [100, 101, 102, 103, 104]


def test_matrices_are_sixteen_numbers(system, documents):
    document = nacre.Document.parse(documents["matrix"])
    shader = system.compile_outputs(document, ["out"], live=["*"])
    rows = numpy.arange(1, 17, dtype="float32").reshape(4, 4)
    assert shader.parameters["m/value"] == tuple(range(1, 17))
    instance = shader.instance({"m/value": 2 * rows})
    assert numpy.array_equal(shader.run({}, count=2)["out"], [rows.T.ravel()] * 2)
    out = numpy.zeros((3, 4, 4), "float32")
    shader.run({"out": out}, instance=instance)
    assert numpy.array_equal(out, [2 * rows.T] * 3)


def test_varying_matrices_come_with_points(system, documents):
    document = nacre.Document.parse(documents["matrix"])
    shader = system.compile_outputs(document, ["out"], live=["*"], varying=["m/value"])
    rows = numpy.arange(48, dtype="float32").reshape(3, 4, 4)
    expected = rows.transpose(0, 2, 1).reshape(3, 16)
    assert numpy.array_equal(shader.run({"m/value": rows})["out"], expected)
    assert numpy.array_equal(shader.run({"m/value": rows.reshape(3, 16)})["out"], expected)
    one = shader.run({"m/value": rows[1].ravel().tolist()}, count=1)["out"]
    assert numpy.array_equal(one, expected[1:2])


def test_footprints_are_scaled_by_an_instance(system):
    """The edge of splitlr is box-filtered over the footprint, so a ramp of its width."""
    document = nacre.Document.parse("""<materialx version="1.39">
      <splitlr name="edge" type="float"><input name="valuel" type="float" value="1"/>
        <input name="valuer" type="float" value="3"/></splitlr>
      <output name="out" type="float" nodename="edge"/></materialx>""")
    shader = system.compile_outputs(document, ["out"], live_footprints=True)
    assert shader.parameters["footprint_scale"] == 1.0
    u = numpy.linspace(0, 1, 101, dtype="float32")
    points = {"uv0": numpy.stack([u, u], 1), "duv0dx": (0.125, 0), "duv0dy": (0, 0.5)}
    for scale in (0.0, 1.0, 4.0):
        found = shader.run(points, instance=shader.instance({"footprint_scale": scale}))["out"]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            ramp = 2 + numpy.clip(2 * (u - 0.5) / (0.125 * scale), -1, 1)
        expected = ramp if scale else numpy.where(u > 0.5, 3, 1)
        assert numpy.allclose(found, expected, atol=1e-5), scale
