"""Blender's compositor, which shares no code with ours, decodes the Cryptomattes of `nacre render`."""

import bpy
import nacre
import numpy
import pytest

SIZE = 24
# One card before the other, from where the camera that fits them looks; a quarter of each is seen
# of pixels in part.
SCENE = """v -1 0.1 -0.9
v 0.93 0 -0.9
v 0.9 0.97 -0.9
v -0.95 1 -0.9
v -0.4 -0.5 0.3
v 1.1 -0.4 0.3
v 0.3 0.77 0.3
o far card
f 1 2 3 4
o near
f 5 6 7
"""
UNLIT = """<surface_unlit name="s{name}" type="surfaceshader">
  <input name="emission_color" type="color3" value="{value}, {value}, {value}"/></surface_unlit>
<surfacematerial name="{name}" type="material">
  <input name="surfaceshader" type="surfaceshader" nodename="s{name}"/></surfacematerial>
"""
LOOK = """<look name="l"><materialassign name="a" material="{far}" geom="/far card"/>
<materialassign name="b" material="{near}" geom="/near"/></look>
"""


def picture(path):
    """(SIZE, SIZE) of the red channel, rows from the bottom."""
    image = bpy.data.images.load(str(path))
    return numpy.array(image.pixels[:], "float32").reshape(SIZE, SIZE, 4)[..., 0]


def rendered(folder, out, far, near, **options):
    """An image in which a material "white" shines and "black" does not: white's coverage."""
    (folder / "scene.obj").write_text(SCENE)
    (folder / "scene.mtlx").write_text('<materialx version="1.39">' + UNLIT.format(name="white", value=1)
                                       + UNLIT.format(name="black", value=0)
                                       + LOOK.format(far=far, near=near) + "</materialx>")
    return nacre.render(folder / "scene.mtlx", out=folder / out, scene=folder / "scene.obj", size=SIZE, spp=16,
                        environment_scale=0, **options)


def matte(file, name, folder):
    """What CompositorNodeCryptomatteV2 makes of a name."""
    scene = bpy.context.scene
    scene.use_nodes = True
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    if scene.camera is None:
        bpy.ops.object.camera_add()
        scene.camera = bpy.context.object
    tree = scene.node_tree
    tree.nodes.clear()
    decoder = tree.nodes.new("CompositorNodeCryptomatteV2")
    decoder.source, decoder.image = "IMAGE", bpy.data.images.load(str(file))
    decoder.matte_id = name
    out = tree.nodes.new("CompositorNodeOutputFile")
    out.base_path = str(folder)
    out.format.file_format, out.format.color_depth = "OPEN_EXR", "32"
    out.file_slots[0].path = "matte_"
    tree.links.new(decoder.outputs["Matte"], out.inputs[0])
    tree.links.new(decoder.outputs["Image"], tree.nodes.new("CompositorNodeComposite").inputs["Image"])
    bpy.ops.render.render()
    return picture(next(folder.glob("matte_*.exr")))


@pytest.mark.parametrize("name, far, near", [("far card", "white", "black"), ("near", "black", "white")])
def test_mattes_are_coverage(tmp_path, name, far, near):
    coverage = picture(rendered(tmp_path, "coverage.exr", far, near))
    file = rendered(tmp_path, "mattes.exr", far, near, aov="crypto_object")
    decoded = matte(file, name, tmp_path)
    partly = (coverage > 0) & (coverage < 1)
    assert partly.sum() > 20 and (coverage == 1).sum() > 20
    numpy.testing.assert_allclose(decoded, coverage, atol=1e-5)


def test_materials_have_mattes_too(tmp_path):
    coverage = picture(rendered(tmp_path, "coverage.exr", "white", "black"))
    decoded = matte(rendered(tmp_path, "mattes.exr", "white", "black", aov="crypto_material"), "white",
                    tmp_path)
    numpy.testing.assert_allclose(decoded, coverage, atol=1e-5)
