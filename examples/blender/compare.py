#!/usr/bin/env python3
"""Renders baked materials by Blender's Cycles beside the documents' own by `nacre render`.

usage: PYTHONPATH=build/python compare.py OUT [--size 192] [--texels 1024] [--spp 128] [DOCUMENT...]

The same triangles, camera and light (../ball_scene.py). A Principled BSDF is another model than those
of MaterialX: the table says by how much light that leaves the ball differs, in all and pixel by
pixel. OUT/compare.png: Cycles, nacre render, and twice their difference around grey.
"""

import argparse
import math
import os
import pathlib
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import nacre  # noqa: E402
import nacre_bake  # noqa: E402
from ball_scene import DEPTH, FLOOR, LAMP, POSITION, SKY, TARGET, YFOV, meshes, write  # noqa: E402

DOCUMENTS = pathlib.Path(__file__).resolve().parents[1] / "documents"
NAMES = ("brass", "plastic", "glass", "marble", "velvet")


def turned(vector):
    """Of y up, for z up."""
    return vector[0], -vector[2], vector[1]


def add_mesh(name, material):
    positions, normals, triangles, uv = meshes()[name]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([turned(p) for p in positions], [], triangles)
    layer = mesh.uv_layers.new()
    for loop, corner in zip(layer.data, mesh.loops):
        u, v = uv[corner.vertex_index]
        loop.uv = u, 1 - v
    for each in mesh.polygons:
        each.use_smooth = True
    mesh.normals_split_custom_set_from_vertices([turned(n) for n in normals])
    mesh.materials.append(material)
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def plain(name, kind, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output, node = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(kind)
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


def set_up(size, spp):
    """The scene but for the ball's material; the ball."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    ball = add_mesh("ball", bpy.data.materials.new("none"))
    add_mesh("floor", plain("floor", "ShaderNodeBsdfDiffuse", Color=(FLOOR, FLOOR, FLOOR, 1)))
    add_mesh("lamp", plain("lamp", "ShaderNodeEmission", Color=(*(x / LAMP[0] for x in LAMP), 1),
                           Strength=LAMP[0]))
    camera = bpy.data.cameras.new("camera")
    camera.angle = YFOV
    seen_from = bpy.data.objects.new("camera", camera)
    away = numpy.subtract(TARGET, POSITION)
    seen_from.location = turned(POSITION)
    seen_from.rotation_euler = math.pi / 2 + math.atan2(away[1], math.hypot(away[0], away[2])), 0, 0
    scene.collection.objects.link(seen_from)
    scene.camera = seen_from
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = SKY, SKY, SKY, 1
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = "CPU", spp, False, False
    cycles.pixel_filter_type, cycles.sample_clamp_indirect, cycles.blur_glossy = "BOX", 0, 0
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = DEPTH
    return ball


def pixels(file):
    """Of a picture as it is stored, from the top."""
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    read = numpy.empty(4 * width * height, "float32")
    image.pixels.foreach_get(read)
    bpy.data.images.remove(image)
    return numpy.float64(read.reshape(height, width, 4)[::-1, :, :3])


def cycles_picture(file):
    bpy.context.scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)
    return pixels(file)


def of_ball(size):
    """Where pixels see the ball, whole: its silhouette is an ellipse."""
    away = numpy.subtract(TARGET, POSITION)
    forward = away / numpy.linalg.norm(away)
    right = numpy.cross(forward, (0, 1, 0)) / math.hypot(forward[0], forward[2])
    up = numpy.cross(right, forward)
    y, x = (1 - (2 * numpy.mgrid[:size, :size] + 1) / size) * math.tan(YFOV / 2)
    rays = forward - x[..., None] * right + y[..., None] * up
    rays /= numpy.linalg.norm(rays, axis=-1, keepdims=True)
    to_ball = numpy.subtract([0, 1, 0], POSITION)
    along = rays @ to_ball
    return to_ball @ to_ball - along**2 < 0.97


def write_sheet(file, rows):
    sheet = numpy.vstack(rows)
    image = bpy.data.images.new("sheet", sheet.shape[1], sheet.shape[0])
    rgba = numpy.ones((*sheet.shape[:2], 4), "float32")
    rgba[..., :3] = sheet[::-1]
    image.pixels.foreach_set(rgba.ravel())
    image.filepath_raw, image.file_format = str(file), "PNG"
    image.save()


def encoded(picture):
    return numpy.clip(1 - numpy.exp(-1.5 * picture), 0, 1) ** (1 / 2.2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("documents", nargs="*", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=192)
    parser.add_argument("--texels", type=int, default=1024)
    parser.add_argument("--spp", type=int, default=128)
    asked = parser.parse_intermixed_args()
    asked.out = asked.out.resolve()
    ball, inside, rows = set_up(asked.size, asked.spp), of_ball(asked.size), []
    print("| document | Cycles | nacre render | difference | root mean square |\n"
          "| --- | ---: | ---: | ---: | ---: |")
    for document in asked.documents or [DOCUMENTS / f"{name}.mtlx" for name in NAMES]:
        folder = asked.out / document.stem
        folder.mkdir(parents=True, exist_ok=True)
        material, warned = nacre_bake.bake_material(document, folder=folder / "textures", size=asked.texels)
        print(*(f"{document.name}: {each}" for each in warned), sep="\n", file=sys.stderr)
        ball.data.materials[0] = material
        a = cycles_picture(folder / "cycles.exr")
        file, options = write(folder, document, material.name)
        b = pixels(nacre.render(file, out=folder / "nacre.exr", size=asked.size, spp=asked.spp, **options))
        mean = a[inside].mean(), b[inside].mean()
        deviation = numpy.sqrt(((a - b)[inside] ** 2).mean())
        print(f"| {document.stem} | {mean[0]:.4f} | {mean[1]:.4f} | {100 * (mean[0] / mean[1] - 1):+.1f} % |"
              f" {100 * deviation / mean[1]:.0f} % |", flush=True)
        rows.append(numpy.hstack([encoded(a), encoded(b), numpy.clip(0.5 + 2 * (a - b), 0, 1)]))
    write_sheet(asked.out / "compare.png", rows)


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # Blender as a module may wait for a thread of its own for ever, at its end.
