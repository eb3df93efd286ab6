"""Materials on arrays, against the closed form of a diffuse lobe."""

import math

import nacre
import numpy
import pytest

Entry = nacre.Entry
COLOR = numpy.array([0.25, 0.5, 0.75], "float32")
COUNT = 2000
N = (0.0, 0.0, 1.0)


def hemisphere(seed):
    random = numpy.random.default_rng(seed)
    directions = random.normal(size=(COUNT, 3)).astype("float32")
    directions[:, 2] = numpy.abs(directions[:, 2]) + 0.01
    return directions / numpy.linalg.norm(directions, axis=1, keepdims=True)


WO, WI = hemisphere(1), hemisphere(2)
POINTS = nacre.surface_points(numpy.zeros((COUNT, 3), "float32"), N, WO, T=(1.0, 0.0, 0.0))


def test_f_is_color_cosine_over_pi(lambert):
    results = lambert.run(POINTS | {"wi": WI}, Entry.EVALUATE)
    cosine = WI[:, 2:] / math.pi
    assert results["f"].shape == (COUNT, 3) and results["pdf"].shape == (COUNT,)
    numpy.testing.assert_allclose(results["f"], COLOR * cosine, rtol=1e-5)
    numpy.testing.assert_allclose(results["pdf"], cosine[:, 0], rtol=1e-5)


def test_albedo_is_the_color(lambert):
    albedo = lambert.run(POINTS, Entry.ALBEDO)["albedo"]
    numpy.testing.assert_allclose(albedo, numpy.broadcast_to(COLOR, (COUNT, 3)), rtol=1e-5)


def test_samples_are_cosine_distributed(lambert):
    u = numpy.random.default_rng(3).random((COUNT, 3), "float32")
    results = lambert.run(POINTS | {"u": u}, Entry.SAMPLE)
    flags = results["flags"]
    assert flags.dtype == numpy.int32
    assert (flags == nacre.SampleFlag.VALID).all()
    numpy.testing.assert_allclose(results["pdf"], results["wi"][:, 2] / math.pi, rtol=1e-4)
    numpy.testing.assert_allclose(results["weight"], numpy.broadcast_to(COLOR, (COUNT, 3)),
                                  rtol=1e-4)
    # The mean cosine is 2/3, with a standard deviation of sqrt(1/2 - 4/9) a sample.
    assert abs(results["wi"][:, 2].mean() - 2 / 3) < 5 * math.sqrt(1 / 18 / COUNT)


def test_one_point_and_many_directions(system, documents):
    document = nacre.Document.parse(documents["lambert"])
    shader = system.compile_material(document, "M", no_footprints=True,
                                     entries=[Entry.EVALUATE, Entry.EVALUATE_AT])
    normals = hemisphere(4)
    points = nacre.surface_points(numpy.zeros((COUNT, 3), "float32"), normals, normals)
    wi = hemisphere(5)[:50]
    at = shader.run(points | {"wi": wi}, Entry.EVALUATE_AT, point=7)
    assert at["f"].shape == (50, 3)
    cosine = numpy.clip(wi @ normals[7], 0, None)[:, None] / math.pi
    numpy.testing.assert_allclose(at["f"], COLOR * cosine, rtol=1e-4, atol=1e-6)
    one = nacre.surface_points((0.0, 0.0, 0.0), normals[7], normals[7])
    alone = shader.run(one | {"wi": wi}, Entry.EVALUATE)
    assert numpy.array_equal(alone["f"], at["f"])


def test_variants_are_what_each_is_by_itself(system, documents):
    document = nacre.Document.parse(documents["lambert"])
    options = [{"no_footprints": True}, {"no_footprints": True, "entries": [Entry.ALBEDO]}]
    camera, albedo = system.compile_variants(document, "M", options)
    assert camera.has(Entry.SAMPLE) and not albedo.has(Entry.SAMPLE)
    normals = hemisphere(4)
    points = nacre.surface_points(numpy.zeros((COUNT, 3), "float32"), normals, normals)
    alone = system.compile_material(document, "M", **options[1]).run(points, Entry.ALBEDO)
    assert numpy.array_equal(albedo.run(points, Entry.ALBEDO)["albedo"], alone["albedo"])
    assert numpy.array_equal(camera.run(points, Entry.ALBEDO)["albedo"], alone["albedo"])
    with pytest.raises(nacre.Error):
        system.compile_variants(document, "M", [{}, {"working_space": "acescg"}])


def test_points_past_the_arrays_are_refused(system, documents):
    """A lobe that is alone has no state: what is too short then is wo."""
    shader = system.compile_material(nacre.Document.parse(documents["lambert"]), "M",
                                     no_footprints=True, entries=[Entry.EVALUATE_AT])
    assert shader.state_count == 0
    points = nacre.surface_points(numpy.zeros((3, 3), "float32"), N, WO[:3])
    with pytest.raises(nacre.Error) as caught:
        shader.run(points | {"wi": WI}, Entry.EVALUATE_AT, point=3)
    assert caught.value.diagnostics[0].code == "short-array"
    binding = shader.bind(points | {"wi": WI}, entries=[Entry.EVALUATE_AT])
    binding.run(Entry.EVALUATE_AT, point=2)
    with pytest.raises(nacre.Error) as caught:
        binding.run(Entry.EVALUATE_AT, point=3)
    assert caught.value.diagnostics[0].code == "short-array"


def test_the_state_is_the_callers_if_it_is_bound(system, documents):
    two = system.compile_material(nacre.Document.parse(documents["two_lobes"]), "M",
                                  no_footprints=True)
    assert two.state_count > 0
    state = numpy.zeros((two.state_count, COUNT), "float32").T
    f = numpy.zeros((COUNT, 3), "float32")
    binding = two.bind(POINTS | {"wi": WI, "state": state, "f": f},
                       entries=[Entry.BEGIN, Entry.EVALUATE])
    binding.run(Entry.BEGIN)
    binding.run(Entry.EVALUATE)
    assert numpy.array_equal(f, two.run(POINTS | {"wi": WI}, Entry.EVALUATE)["f"])


def test_the_state_may_end_with_a_truth_value(system):
    """Whether roughness that comes with points is a mirror's is kept too."""
    document = nacre.Document.parse("""<materialx version="1.39">
      <conductor_bsdf name="b" type="BSDF"><input name="roughness" type="vector2" value=".1, .1"/>
      </conductor_bsdf><surface name="s" type="surfaceshader">
        <input name="bsdf" type="BSDF" nodename="b"/></surface><surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial></materialx>""")
    shader = system.compile_material(document, "M", no_footprints=True, live=["b/roughness"],
                                     varying=["b/roughness"], compensation="nothing")
    types = [each.dtype for each in shader.results(Entry.BEGIN) if each.name.startswith("state")]
    assert "int32" in types
    points = POINTS | {"b/roughness": (0.1, 0.2)}
    values = shader.run(points | {"wi": WI}, Entry.EVALUATE)
    assert (values["pdf"] > 0).mean() > 0.9
    samples = shader.run(points | {"u": hemisphere(8)}, Entry.SAMPLE)
    assert (samples["flags"] & nacre.SampleFlag.VALID).mean() > 0.9


def test_points_past_the_state_are_refused(system, documents):
    two = system.compile_material(nacre.Document.parse(documents["two_lobes"]), "M",
                                  no_footprints=True, entries=[Entry.EVALUATE_AT])
    points = nacre.surface_points((0.0, 0.0, 0.0), N, (0.0, 0.0, 1.0))
    state = numpy.zeros((3, two.state_count), "float32")
    binding = two.bind(points | {"wi": WI, "state": state}, entries=[Entry.EVALUATE_AT])
    binding.run(Entry.EVALUATE_AT, point=2)
    with pytest.raises(nacre.Error) as caught:
        binding.run(Entry.EVALUATE_AT, point=3)
    assert caught.value.diagnostics[0].code == "short-array"


def test_results_into_structures(lambert):
    paths = numpy.zeros(COUNT, [("wo", "f4", 3), ("wi", "f4", 3), ("f", "f4", 3), ("pdf", "f4")])
    paths["wo"], paths["wi"] = WO, WI
    named = POINTS | {name: paths[name] for name in paths.dtype.names}
    lambert.run(named, Entry.EVALUATE)
    numpy.testing.assert_allclose(paths["pdf"], WI[:, 2] / math.pi, rtol=1e-5)
    numpy.testing.assert_allclose(paths["f"], COLOR * WI[:, 2:] / numpy.pi, rtol=1e-5)


def test_parts_by_lobe(system, documents):
    shader = system.compile_material(nacre.Document.parse(documents["lambert"]), "M",
                                     no_footprints=True, by_lobe=True)
    results = shader.run(POINTS | {"wi": WI}, Entry.EVALUATE)
    assert numpy.array_equal(results["f.lobe0"], results["f"])
    assert [(lobe.name, lobe.kinds) for lobe in shader.lobes] == [
        ("oren_nayar_diffuse_bsdf", nacre.LobeKind.DIFFUSE_REFLECTION)]


def test_lobes_wanted_and_transport_come_with_points(system, documents):
    shader = system.compile_material(nacre.Document.parse(documents["lambert"]), "M",
                                     no_footprints=True, lobes_wanted=True, transport=True)
    wanted = numpy.full(COUNT, nacre.LobeKind.DIFFUSE_REFLECTION, "int32")
    wanted[0] = nacre.LobeKind.GLOSSY_REFLECTION
    carried = numpy.full(COUNT, nacre.Transport.IMPORTANCE, "int32")
    results = shader.run(POINTS | {"wi": WI, "lobes_wanted": wanted, "transport": carried},
                         Entry.EVALUATE)
    assert not results["f"][0].any() and results["pdf"][0] == results["kinds"][0] == 0
    assert (results["kinds"][1:] == nacre.LobeKind.DIFFUSE_REFLECTION).all()
    numpy.testing.assert_allclose(results["pdf"][1:], WI[1:, 2] / math.pi, rtol=1e-5)
    with pytest.raises(nacre.Error, match="lobes_wanted"):
        shader.run(POINTS | {"wi": WI, "transport": carried}, Entry.EVALUATE)


def test_facets_may_lose_what_is_scattered_several_times(system, documents):
    """White metal returns all light, GGX facets of alpha 1 alone 1 - ln 2 of it, seen from above:
    there h = cos(theta_h) has the density 2 h, wi the cosine w = 2 h^2 - 1, and of what goes up
    G2 / G1 = 2 w / (1 + w) is seen."""
    metal = nacre.Document.parse(documents["white_metal"])
    above = POINTS | {"wo": (0, 0, 1)}
    albedo = {kind: system.compile_material(metal, "M", no_footprints=True, compensation=kind)
              .run(above, Entry.ALBEDO)["albedo"][0, 0] for kind in ("all", "reflection", "nothing")}
    assert albedo["all"] == albedo["reflection"] == pytest.approx(1, abs=1e-6)
    assert albedo["nothing"] == pytest.approx(1 - math.log(2), abs=3e-3)
    with pytest.raises(ValueError, match="compensation"):
        system.compile_material(metal, "M", compensation="some")


def test_the_index_outside_comes_with_points(system, documents):
    glass = nacre.Document.parse(documents["glass"])
    shader = system.compile_material(glass, "M", no_footprints=True, varying=["exterior_index"])
    outside = numpy.linspace(1, 1.49, COUNT, dtype="float32")  # Nearer light goes straight on.
    u = numpy.full((COUNT, 3), 0.99, "float32")
    bent = shader.run(POINTS | {"u": u, "exterior_index": outside}, Entry.SAMPLE)["wi"]
    numpy.testing.assert_allclose(bent[:, 0] * 1.5, -WO[:, 0] * outside, atol=1e-6)  # Snell.


def test_what_a_material_lacks_is_empty(lambert):
    assert not lambert.has(Entry.EMISSION)
    assert lambert.run(POINTS, Entry.EMISSION) == {}
    assert not lambert.has_back
    assert lambert.state_count >= 0


def test_channels_say_what_they_are(lambert):
    wi = {each.name: each for each in lambert.inputs(Entry.EVALUATE)}["wi.x"]
    assert (wi.component, wi.dtype, wi.role, wi.unit) == (0, "float32", "direction", "unit vector")
    names = {each.name for each in lambert.results(Entry.EVALUATE)}
    assert {"f.x", "f.y", "f.z", "pdf"} <= names


def test_emitted_light_carries_the_power(system):
    document = nacre.Document.parse("""<materialx version="1.39">
      <uniform_edf name="e" type="EDF"><input name="color" type="color3" value="1, 2, 4"/></uniform_edf>
      <surface name="S" type="surfaceshader"><input name="edf" type="EDF" nodename="e"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>""")
    shader = system.compile_material(document, "M", no_footprints=True,
                                     entries=[Entry.EMISSION, Entry.EMIT])
    points = nacre.surface_points((0.0, 0.0, 0.0), N, N)
    u = numpy.random.default_rng(7).random((COUNT, 3), "float32")
    light = shader.run(points | {"u": u}, Entry.EMIT)
    assert light["emitted"].shape == (COUNT, 3)
    numpy.testing.assert_allclose(light["pdf"], abs(light["emitted"][:, 2]) / (2 * math.pi), rtol=1e-4)
    numpy.testing.assert_allclose(light["weight"][:, 1], 4 * math.pi, rtol=1e-4)
    seen = shader.run(points | {"wo": light["emitted"]}, Entry.EMISSION)
    numpy.testing.assert_array_equal(seen["pdf"], light["pdf"])


def test_an_error_may_be_asked_for(system, documents):
    document = nacre.Document.parse(documents["white_metal"])
    shader = system.compile_material(document, "M", no_footprints=True, max_error=0.01)
    assert shader.error.p999 <= 0.01 and shader.error.maximum <= 0.03
    assert '"compensation"' in shader.profile
    assert system.compile_material(document, "M").error is None
    rough = system.compile_material(document, "M", no_footprints=True, compensation="nothing",
                                    measure_error=True)
    assert rough.error.maximum > 0.1 and rough.profile is None


def test_a_profile_chooses_for_what_it_names(system, documents):
    document = nacre.Document.parse(documents["white_metal"])
    points = nacre.surface_points((0.0, 0.0, 0.0), N, N) | {"wi": (0.6, 0.0, 0.8)}

    def f(**options):
        shader = system.compile_material(document, "M", no_footprints=True, **options)
        return shader.run(points, Entry.EVALUATE, count=1)["f"][0].tolist()

    profile = """{"nacre_profile": 1, "subjects": [
      {"material": "M", "choices": {"compensation": "nothing"}}]}"""
    assert f(profile=profile) == f(compensation="nothing") != f()
    with pytest.raises(nacre.Error) as caught:
        f(profile="[]")
    assert caught.value.diagnostics[0].code == "bad-profile"


def test_facts_change_no_bit_and_are_found_out(system):
    document = nacre.Document.parse("""<materialx version="1.39">
      <standard_surface name="S" type="surfaceshader"/>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>""")
    options = {"entries": [Entry.SHADE], "no_footprints": True, "live": ["*"]}
    general = system.compile_material(document, "M", **options)
    narrow = system.compile_material(document, "M", facts={"S/coat": (0, 0), "P": (-1, 1)}, **options)
    points = POINTS | {"wi": WI, "u": numpy.random.default_rng(5).random((COUNT, 3), "float32")}

    def is_same(values):
        expected = general.run(points, Entry.SHADE, instance=general.instance(values))
        found = narrow.run(points, Entry.SHADE, instance=narrow.instance(values))
        return all(numpy.array_equal(found[name], expected[name]) for name in expected)

    assert is_same({}) and narrow.points_outside_facts == 0
    assert [fact.name for fact in narrow.facts] == ["S/coat", "P"]
    assert narrow.facts[0].saved is None or narrow.facts[0].saved > 0
    assert narrow.facts[1].saved in (None, 0)  # No kernel reads P.
    assert is_same({"S/coat": 0.5}) and narrow.points_outside_facts == COUNT


def test_facts_that_no_number_fits_are_errors(system):
    document = nacre.Document.parse("""<materialx version="1.39">
      <texcoord name="uv" type="vector2"/><output name="o" type="vector2" nodename="uv"/>
    </materialx>""")
    with pytest.raises(nacre.Error, match="bad-fact"):
        system.compile_outputs(document, ["o"], facts={"uv0": (2, 1)})
