"""Pictures by Mitsuba's path tracer."""

import mitsuba as mi
import numpy
import pytest

RUNS = 6


@pytest.mark.parametrize("name", ["white", "glass", "half"])
def test_what_loses_no_light_is_invisible_in_a_furnace(bsdf, name):
    """Radiance 1 from everywhere is 1 wherever one looks, within noise."""
    import nacre_mitsuba

    scene = mi.load_dict({
        "type": "scene", "integrator": {"type": "path", "max_depth": -1},
        "ball": {"type": "sphere", "bsdf": bsdf(name)}, "sky": {"type": "constant"},
        "sensor": {"type": "perspective", "fov": 20,
                   "to_world": mi.ScalarTransform4f().look_at([0, 4, 1], [0, 0, 0], [0, 0, 1]),
                   "film": {"type": "hdrfilm", "width": 32, "height": 32, "rfilter": {"type": "box"}}}})
    with nacre_mitsuba.eager():
        means = [numpy.array(mi.render(scene, spp=16, seed=seed)).mean() for seed in range(RUNS)]
    deviation = numpy.std(means, ddof=1) / numpy.sqrt(RUNS)
    assert abs(numpy.mean(means) - 1) < 5 * deviation + 1e-5, (means, deviation)
    assert deviation < 0.01


def test_closures_of_mitsuba_take_the_texture(tmp_path):
    """With the same random numbers, a picture of the texture is that of the bitmap that it reads."""
    import nacre_mitsuba

    texels = numpy.random.default_rng(2).random((4, 4, 3), "float32")
    mi.Bitmap(texels).write(str(tmp_path / "texels.exr"))
    (tmp_path / "texels.mtlx").write_text("""<materialx version="1.39">
      <image name="i" type="color3"><input name="file" type="filename" value="texels.exr"/>
        <input name="filtertype" type="string" value="closest"/></image>
      <output name="out" type="color3" nodename="i"/></materialx>""")
    pictures = []
    for reflectance in ({"type": "nacre_texture", "filename": str(tmp_path / "texels.mtlx")},
                        {"type": "bitmap", "filename": str(tmp_path / "texels.exr"), "raw": True,
                         "filter_type": "nearest"}):
        scene = mi.load_dict({
            "type": "scene", "integrator": {"type": "path"}, "sky": {"type": "constant"},
            "square": {"type": "rectangle", "bsdf": {
                "type": "twosided", "bsdf": {"type": "roughplastic", "diffuse_reflectance": reflectance}}},
            "sensor": {"type": "perspective", "fov": 30,
                       "to_world": mi.ScalarTransform4f().look_at([0, 0, 4], [0, 0, 0], [0, 1, 0]),
                       "film": {"type": "hdrfilm", "width": 16, "height": 16}}})
        with nacre_mitsuba.eager():
            pictures.append(numpy.array(mi.render(scene, spp=8)))
    numpy.testing.assert_allclose(*pictures, rtol=1e-3)
    assert pictures[0].std() > 0.05
