"""Live inputs, textures as inputs, and what is refused."""

import drjit as dr
import mitsuba as mi
import nacre
import numpy
import pytest
from conftest import DOCUMENTS, hits

CONTEXT = mi.BSDFContext()
UP = mi.Vector3f(0, 0, 1)


def test_live_inputs_change_by_traverse(bsdf):
    made = bsdf("diffuse", **{"lobe/color": [0.1, 0.2, 0.3]})
    other = bsdf("diffuse", live="lobe/color")

    def colors():
        return [numpy.array(each.eval(CONTEXT, hits(1), UP))[:, 0] * numpy.pi for each in (made, other)]

    numpy.testing.assert_allclose(colors(), [[0.1, 0.2, 0.3], [0.25, 0.5, 0.75]], rtol=1e-5)
    parameters = mi.traverse(made)
    parameters["lobe/color"] = mi.Color3f(0.9, 0.0, 0.5)
    parameters.update()
    numpy.testing.assert_allclose(colors(), [[0.9, 0, 0.5], [0.25, 0.5, 0.75]], rtol=1e-5)
    assert made.shader is other.shader  # Compiled once.


def test_a_texture_gives_an_input_point_by_point(bsdf):
    texels = numpy.random.default_rng(1).random((4, 4, 3), "float32")
    picture = {"type": "bitmap", "data": mi.TensorXf(texels), "raw": True, "filter_type": "nearest"}
    made = bsdf("diffuse", **{"lobe/color": picture})
    row, column = numpy.mgrid[:4, :4].reshape(2, 16)
    si = hits(16, uv=(mi.Float(numpy.float32(column + 0.5) / 4), mi.Float(numpy.float32(row + 0.5) / 4)))
    albedo = numpy.array(made.eval_diffuse_reflectance(si)).T
    numpy.testing.assert_allclose(albedo, texels.reshape(16, 3), rtol=1e-5)


def texel_middles(size):
    down, along = numpy.float32(numpy.mgrid[:size, :size].reshape(2, -1) + 0.5) * numpy.float32(1 / size)
    return hits(size * size, uv=(mi.Float(along), mi.Float(down)))


def test_texels_are_those_of_bake():
    file, output, size = DOCUMENTS / "marble.mtlx", "NG_marble/base_color", 64
    texture = mi.load_dict({"type": "nacre_texture", "filename": str(file), "output": output})
    baked = nacre.bake(nacre.Document(file), [output], size=size)[output]
    found = numpy.array(texture.eval_3(texel_middles(size))).T.reshape(size, size, 3)
    assert (found == baked).all() and found.std() > 0.01
    luminance = numpy.array(texture.eval_1(texel_middles(size)))
    numpy.testing.assert_allclose(luminance, baked.reshape(-1, 3) @ (0.212671, 0.715160, 0.072169),
                                  rtol=1e-5)


def test_pictures_are_as_bitmap_shows_them(tmp_path):
    """Corners of four colours, read by MaterialX and by Mitsuba."""
    texels = numpy.random.default_rng(2).random((2, 2, 3), "float32")
    mi.Bitmap(texels).write(str(tmp_path / "corners.exr"))
    (tmp_path / "corners.mtlx").write_text("""<materialx version="1.39">
      <image name="i" type="color3"><input name="file" type="filename" value="corners.exr"/>
        <input name="filtertype" type="string" value="closest"/></image>
      <output name="out" type="color3" nodename="i"/></materialx>""")
    ours = mi.load_dict({"type": "nacre_texture", "filename": str(tmp_path / "corners.mtlx")})
    theirs = mi.load_dict({"type": "bitmap", "filename": str(tmp_path / "corners.exr"), "raw": True,
                           "filter_type": "nearest"})
    si = texel_middles(2)
    numpy.testing.assert_array_equal(numpy.array(ours.eval_3(si)), numpy.array(theirs.eval_3(si)))


def test_recording_is_refused(bsdf):
    made = bsdf("diffuse")
    with dr.scoped_set_flag(dr.JitFlag.SymbolicLoops, True), pytest.raises(Exception) as caught:
        dr.while_loop((mi.UInt32(0, 1), mi.Float(0, 0)), lambda i, f: i < 3,
                      lambda i, f: (i + 1, f + made.pdf(CONTEXT, hits(2), UP)))
    said = caught.value
    while said.__cause__ is not None:
        said = said.__cause__
    assert "nacre_mitsuba.eager()" in str(said)


@pytest.mark.parametrize("more, text", [
    ({"material": "Z"}, "'Z'; there are: M"),
    ({"lobe/colour": 1.0}, "lobe/colour"),
    ({"filename": "none.mtlx"}, "none.mtlx")])
def test_what_there_is_not_is_said(bsdf, more, text):
    with pytest.raises(Exception, match=".*") as caught:
        bsdf("diffuse", **more)
    assert text in str(caught.value)


def test_what_hits_do_not_have_is_said(bsdf):
    with pytest.raises(Exception, match="geomprop.dirt"):
        bsdf("colored")


def test_what_is_left_out_is_said(bsdf):
    with pytest.warns(UserWarning, match="light that it emits"):
        bsdf("glowing")
