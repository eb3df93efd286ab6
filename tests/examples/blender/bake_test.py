"""The operator: which images and values a Principled BSDF gets, and what Cycles makes of them."""

import math

import bpy
import nacre
import nacre_bake
import numpy
import pytest
from conftest import document, image_behind, principled


def baked(files, name, tmp_path, **more):
    return nacre_bake.bake_material(files[name], folder=tmp_path, size=16, **more)


def numbers(node, *sockets):
    return [pytest.approx(tuple(value) if hasattr(value, "__len__") else value, abs=1e-6)
            for value in (node.inputs[each].default_value for each in sockets)]


@pytest.mark.parametrize("format, color", [("png", "sRGB"), ("exr", "Linear Rec.709")])
def test_images_have_the_spaces_of_what_is_in_them(files, square, tmp_path, format, color):
    assert bpy.ops.nacre.bake_material(filepath=files["ramps"], folder=str(tmp_path), size=16,
                                       format=format) == {"FINISHED"}
    assert square.active_material.name == "M" and len(square.material_slots) == 1
    node = principled(square.active_material)
    for socket, space in (("Base Color", color), ("Roughness", "Non-Color"), ("Normal", "Non-Color")):
        image = image_behind(node.inputs[socket])
        assert image.colorspace_settings.name == space
        assert tuple(image.size) == (16, 16)
    assert node.inputs["Normal"].links[0].from_node.type == "NORMAL_MAP"
    assert node.inputs["Metallic"].default_value == 0 and not node.inputs["Metallic"].is_linked


def test_texels_are_those_of_bake(files, square, tmp_path):
    made, _ = baked(files, "ramps", tmp_path, format="exr")
    expected = nacre.bake(nacre.Document(files["ramps"]), ["G/color", "G/rough"], size=16)
    for socket, output in (("Base Color", "G/color"), ("Roughness", "G/rough")):
        image = image_behind(principled(made).inputs[socket])
        texels = numpy.array(image.pixels[:], "float32").reshape(16, 16, 4)[::-1]
        numpy.testing.assert_array_equal(texels[..., 0], expected[output].reshape(16, 16, -1)[..., 0])


def test_values_and_defaults_of_the_data_library(files, square, tmp_path):
    made, warned = baked(files, "glass", tmp_path)
    node = principled(made)
    found = numbers(node, "Transmission Weight", "IOR", "Roughness", "Coat Roughness", "Base Color")
    # Light goes in and out, and loses the colour twice.
    assert [1, 1.7, 0.2, 0.1, (0.81, 0.64, 0.25, 1)] == found and warned == []
    node = principled(baked(files, "open_pbr", tmp_path)[0])
    found = numbers(node, "Sheen Weight", "Anisotropic", "Thin Film Thickness", "Coat IOR", "Roughness")
    assert [0.5, 0.5, 400, 1.6, 0.3] == found
    assert node.inputs["Tangent"].is_linked
    node = principled(baked(files, "usd", tmp_path)[0])
    found = numbers(node, "Base Color", "Emission Color", "Emission Strength", "Alpha", "Roughness")
    assert [(0.1, 0.2, 0.3, 1), (0, 2, 0, 1), 1, 0.25, 0.5] == found
    node = principled(baked(files, "gltf", tmp_path)[0])
    assert [0, 1, 1, (0.1, 0.2, 0.3, 1)] == numbers(node, "Metallic", "Roughness", "Sheen Weight",
                                                   "Sheen Tint")


def test_what_has_no_socket_is_said(files, square, tmp_path):
    warned = baked(files, "odd", tmp_path)[1]
    assert len(warned) == 1 and "coat_affect_color" in warned[0]


@pytest.mark.parametrize("name, more, text", [
    ("al", {}, "alSurface has no way"),
    ("glass", {"material": "Z"}, "'Z'; there are: M"),
    ("glass", {"filepath": "/none.mtlx"}, "/none.mtlx"),
    ("glass", {"folder": "//textures"}, "save it")])
def test_what_cannot_be_is_an_error(files, square, tmp_path, name, more, text):
    with pytest.raises(RuntimeError, match=text):
        bpy.ops.nacre.bake_material(**{"filepath": files[name], "folder": str(tmp_path), "size": 16} | more)
    assert len(square.material_slots) == 0


def test_baking_again_shows_what_has_changed(square, tmp_path):
    file = tmp_path / "changing.mtlx"

    def middle(value):
        graph = f"""<ramplr name="r" type="float"><input name="valuer" type="float" value="{value}"/></ramplr>
          <output name="out" type="float" nodename="r"/>"""
        file.write_text(document('<input name="metalness" type="float" nodegraph="G" output="out"/>', graph))
        made, _ = nacre_bake.bake_material(file, folder=tmp_path / "textures", size=16, format="exr")
        return image_behind(principled(made).inputs["Metallic"]).pixels[4 * (8 * 16 + 8)], made

    before, made = middle(0.25)
    after, again = middle(1.0)
    assert before == pytest.approx(8.5 / 64) and after == pytest.approx(8.5 / 16)
    assert again == made and len(bpy.data.materials) == 1


def test_cycles_sees_the_graph_where_it_is(files, square, tmp_path):
    """Under an even sky what is diffuse and nothing else has the radiance of its colour."""
    square.data.materials.append(baked(files, "paper", tmp_path, format="exr")[0])
    scene = bpy.context.scene
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.ortho_scale = "ORTHO", 2
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.camera.location = 0, 0, 3
    scene.collection.objects.link(scene.camera)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = 1, 1, 1, 1
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", 16, False
    scene.cycles.pixel_filter_type = "BOX"  # Nothing of what is around the square.
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(tmp_path / "square.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    found = numpy.array(image.pixels[:]).reshape(8, 8, 4)  # The lowest row first.
    found = found[1:-1, 1:-1]  # Interpolated at the edges with what is beyond: the other edge.
    middles = 0.8 * (numpy.arange(1, 7) + 0.5) / 8
    assert math.isclose(found[..., 2].max(), 0, abs_tol=1e-3)
    numpy.testing.assert_allclose(found[..., 0], numpy.broadcast_to(middles, (6, 6)), atol=0.02)
    numpy.testing.assert_allclose(found[..., 1], numpy.broadcast_to(middles[:, None], (6, 6)), atol=0.02)
