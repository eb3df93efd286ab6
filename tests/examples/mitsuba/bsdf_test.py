"""nacre_bsdf: closed forms, Mitsuba's own closures, and its chi-square test."""

import math

import drjit as dr
import mitsuba as mi
import numpy
import pytest
from conftest import hits, numbers, sphere_of_directions

COUNT = 4096
CONTEXT = mi.BSDFContext()


def test_diffuse_is_that_of_mitsuba(bsdf):
    ours = bsdf("diffuse")
    theirs = mi.load_dict({"type": "diffuse",
                           "reflectance": {"type": "rgb", "value": [0.25, 0.5, 0.75]}})
    si, wo = hits(COUNT, (0.3, -0.5, 0.8)), sphere_of_directions(COUNT)
    for a, b in zip(ours.eval_pdf(CONTEXT, si, wo), theirs.eval_pdf(CONTEXT, si, wo)):
        numpy.testing.assert_allclose(numpy.array(a), numpy.array(b), rtol=1e-5, atol=1e-7)
    albedo = ours.eval_diffuse_reflectance(si)
    numpy.testing.assert_allclose(numpy.array(albedo)[:, 0], [0.25, 0.5, 0.75], rtol=1e-5)


@pytest.mark.parametrize("mode", [mi.TransportMode.Radiance, mi.TransportMode.Importance])
def test_normals_that_lean_are_those_of_mitsuba(bsdf, mode):
    """Its integrators correct for them where paths come from lights, and its closures do not."""
    theirs = mi.load_dict({"type": "diffuse",
                           "reflectance": {"type": "rgb", "value": [0.25, 0.5, 0.75]}})
    si, wo = hits(COUNT, (0.1, -0.2, 0.9)), sphere_of_directions(COUNT)
    si.sh_frame = mi.Frame3f(dr.normalize(mi.Vector3f(0.3, 0.2, 0.9)))
    found = [numpy.array(each.eval(mi.BSDFContext(mode), si, wo)) for each in (bsdf("diffuse"), theirs)]
    numpy.testing.assert_allclose(*found, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("z", [0.8, -0.8])
@pytest.mark.parametrize("mode", [mi.TransportMode.Radiance, mi.TransportMode.Importance])
def test_smooth_glass_is_that_of_mitsuba(bsdf, z, mode):
    """Both directions of it: chances, weights, indices and densities, for all that paths carry."""
    context = mi.BSDFContext(mode)
    si = hits(COUNT, (0.6, 0, z))
    u = numbers(COUNT, 3)
    theirs = mi.load_dict({"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0})
    for transmits in (False, True):
        found = []
        for each in (bsdf("glass"), theirs):
            bs, weight = each.sample(context, si, u.x, u)
            of_kind = numpy.array((bs.wo.z * z < 0) == transmits)
            assert of_kind.any()
            is_delta = mi.BSDFFlags.DeltaTransmission if transmits else mi.BSDFFlags.DeltaReflection
            assert (numpy.array(bs.sampled_type)[of_kind] == int(is_delta)).all()
            numbers_of = [*bs.wo, bs.pdf, bs.eta, *weight]
            found.append([float((each + dr.zeros(mi.Float, COUNT)).numpy()[of_kind][0])
                          for each in numbers_of])
        numpy.testing.assert_allclose(*found, rtol=2e-5, atol=1e-6)


def test_share_of_glass_that_reflects_is_fresnels(bsdf):
    si = hits(40 * COUNT, (0.9, 0, 0.3))
    bs, _ = bsdf("glass").sample(CONTEXT, si, numbers(40 * COUNT, 8).x, numbers(40 * COUNT, 9))
    share, expected = numpy.mean(bs.wo.z.numpy() > 0), mi.fresnel(si.wi.z[0], 1.5)[0][0]
    assert abs(share - expected) < 5 * math.sqrt(expected * (1 - expected) / (40 * COUNT))


@pytest.mark.parametrize("name, wi", [
    ("diffuse", (0.5, 0, 0.7)), ("brushed", (0.3, 0.4, 0.5)), ("gloss", (0.7, 0, 0.4)),
    ("rough_glass", (0.4, 0.1, 0.8)), ("rough_glass", (0.4, 0.1, -0.8))])
def test_samples_have_the_density_that_it_says(bsdf, name, wi):
    from mitsuba.chi2 import ChiSquareTest, SphericalDomain

    made = bsdf(name)

    def sample(u):
        bs, weight = made.sample(CONTEXT, hits(dr.width(u), wi), u[0], mi.Point2f(u[1], u[2]))
        return bs.wo, dr.select(dr.any(weight > 0), mi.Float(1), 0)

    def density(wo):
        return made.pdf(CONTEXT, hits(dr.width(wo), wi), wo)

    test = ChiSquareTest(SphericalDomain(), sample, density, sample_dim=3, sample_count=200_000,
                         res=41, ires=16)
    assert test.run(), test.messages


@pytest.mark.parametrize("name", ["diffuse", "brushed", "gloss", "rough_glass"])
def test_weights_are_values_over_densities(bsdf, name):
    made, si = bsdf(name), hits(COUNT, (0.5, 0.2, 0.6))
    bs, weight = made.sample(CONTEXT, si, numbers(COUNT, 1).x, numbers(COUNT, 2))
    f, pdf = made.eval_pdf(CONTEXT, si, bs.wo)
    valid = bs.pdf.numpy() > 0
    assert valid.mean() > 0.8  # Others go below the horizon.
    numpy.testing.assert_allclose(pdf.numpy()[valid], bs.pdf.numpy()[valid], rtol=5e-3)
    numpy.testing.assert_allclose(numpy.array(f / pdf)[:, valid], numpy.array(weight)[:, valid],
                                  rtol=5e-3)


def test_a_context_asks_for_some_lobes(bsdf):
    made, si = bsdf("gloss"), hits(COUNT, (0.5, 0, 0.6))
    kinds = {mi.BSDFFlags.DiffuseReflection: 0, mi.BSDFFlags.GlossyReflection: 1}
    parts = []
    for kind, component in kinds.items():
        some = mi.BSDFContext()
        some.type_mask = int(kind)
        parts.append(numpy.array(made.eval(some, si, sphere_of_directions(COUNT))))
        one = mi.BSDFContext(mi.TransportMode.Radiance, 0xffffffff, component)
        same = numpy.array(made.eval(one, si, sphere_of_directions(COUNT)))
        assert (same == parts[-1]).all() and (same > 0).any()
        bs, _ = made.sample(some, si, numbers(COUNT, 1).x, numbers(COUNT, 2))
        assert set(bs.sampled_type.numpy()[bs.pdf.numpy() > 0]) == {int(kind)}
        assert set(bs.sampled_component.numpy()[bs.pdf.numpy() > 0]) == {component}
    whole = numpy.array(made.eval(CONTEXT, si, sphere_of_directions(COUNT)))
    numpy.testing.assert_allclose(parts[0] + parts[1], whole, rtol=1e-4, atol=1e-6)


def test_hits_that_are_not_active_get_nothing_and_change_nothing(bsdf):
    made, wo = bsdf("brushed"), sphere_of_directions(COUNT)
    si = hits(COUNT, (0.5, 0.2, 0.6))
    active = dr.arange(mi.UInt32, COUNT) % 3 == 0
    everywhere = numpy.array(made.eval(CONTEXT, si, wo))
    some = numpy.array(made.eval(CONTEXT, si, wo, active))
    assert (some[:, active.numpy()] == everywhere[:, active.numpy()]).all()
    assert (some[:, ~active.numpy()] == 0).all()
    assert not numpy.array(made.eval(CONTEXT, si, wo, mi.Bool(False))).any()


def test_opacity_lets_light_straight_on(bsdf):
    made, si = bsdf("half"), hits(40 * COUNT, (0.5, 0, 0.6))
    assert made.eval_null_transmission(si)[0][0] == 0.75
    bs, weight = made.sample(CONTEXT, si, numbers(40 * COUNT, 1).x, numbers(40 * COUNT, 2))
    is_null = bs.sampled_type.numpy() == int(mi.BSDFFlags.Null)
    assert abs(is_null.mean() - 0.75) < 5 * math.sqrt(0.75 * 0.25 / (40 * COUNT))
    for wo, wi in zip(bs.wo, si.wi):
        numpy.testing.assert_allclose(wo.numpy()[is_null], -wi[0], atol=1e-7)
    numpy.testing.assert_allclose(numpy.array(weight), 1, rtol=1e-4)
    f, pdf = made.eval_pdf(CONTEXT, si, mi.Vector3f(0, 0, 1))
    numpy.testing.assert_allclose([f[0][0], pdf[0]], 0.25 / math.pi, rtol=1e-5)
    # Without it all samples scatter, and what does not is lost.
    some = mi.BSDFContext()
    some.type_mask = int(mi.BSDFFlags.DiffuseReflection)
    bs, weight = made.sample(some, si, numbers(40 * COUNT, 1).x, numbers(40 * COUNT, 2))
    assert (bs.sampled_type.numpy() == int(mi.BSDFFlags.DiffuseReflection)).all()
    numpy.testing.assert_allclose(numpy.array(weight), 0.25, rtol=1e-4)
    assert made.pdf(some, si, mi.Vector3f(0, 0, 1))[0] == pytest.approx(1 / math.pi, rel=1e-5)
