"""The scene for Blender's Cycles: a path tracer on the CPU, as it comes, but for what bounds its light."""

import math
import time

import numpy
from scene import COLOR, DEPTH, FLOOR, GOLD, POSITION, TARGET, YFOV, geometry, sky

PACKAGES = ("bpy==4.5.15",)
# Blender's roughness is the root of alpha.
BALLS = {
    "gold, roughness .3": ("ShaderNodeBsdfMetallic", {"fresnel_type": "PHYSICAL_CONDUCTOR", "distribution": "GGX"},
                           {"Roughness": 0.3 ** 0.5, "IOR": GOLD["eta"], "Extinction": GOLD["k"]}),
    "plastic, roughness .3": ("ShaderNodeBsdfPrincipled", {},
                              {"Roughness": 0.3 ** 0.5, "Base Color": (*COLOR, 1)}),
    "glass, smooth": ("ShaderNodeBsdfGlass", {"distribution": "GGX"}, {"Roughness": 0, "IOR": 1.5}),
    "glass, roughness .2": ("ShaderNodeBsdfGlass", {"distribution": "GGX"},
                            {"Roughness": 0.2 ** 0.5, "IOR": 1.5}),
}
DIFFUSE = "ShaderNodeBsdfDiffuse", {}, {"Color": (FLOOR, FLOOR, FLOOR, 1)}


def turned(vector):
    """Of y up, for z up."""
    return vector[0], -vector[2], vector[1]


class Peer:
    def __init__(self, subject, folder, asked):
        import bpy

        self.bpy, self.folder = bpy, folder
        bpy.ops.wm.read_factory_settings(use_empty=True)
        for name, rows in geometry().items():
            self.add_mesh(name, rows, BALLS[subject] if name == "ball" else DIFFUSE)
        self.add_camera()
        self.add_sky()
        self.set_up(asked.size)

    def add_mesh(self, name, rows, shader):
        positions, normals, triangles = rows
        mesh = self.bpy.data.meshes.new(name)
        mesh.from_pydata([turned(p) for p in positions], [], triangles)
        for each in mesh.polygons:
            each.use_smooth = True
        mesh.normals_split_custom_set_from_vertices([turned(n) for n in normals])
        mesh.materials.append(self.material(name, *shader))
        self.bpy.context.scene.collection.objects.link(self.bpy.data.objects.new(name, mesh))

    def material(self, name, kind, settings, inputs):
        material = self.bpy.data.materials.new(name)
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        output, node = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(kind)
        for key, value in settings.items():
            setattr(node, key, value)
        for key, value in inputs.items():
            node.inputs[key].default_value = value
        tree.links.new(node.outputs[0], output.inputs["Surface"])
        return material

    def add_camera(self):
        camera = self.bpy.data.cameras.new("camera")
        camera.angle = YFOV
        seen_from = self.bpy.data.objects.new("camera", camera)
        away = numpy.subtract(TARGET, POSITION)
        seen_from.location = turned(POSITION)
        seen_from.rotation_euler = math.pi / 2 + math.atan2(away[1], math.hypot(away[0], away[2])), 0, 0
        self.bpy.context.scene.collection.objects.link(seen_from)
        self.bpy.context.scene.camera = seen_from

    def add_sky(self):
        rows = numpy.roll(sky(), -sky().shape[1] // 4, axis=1)  # u = 0 is where ours has 1/4.
        rgba = numpy.ones((*rows.shape[:2], 4), "float32")
        rgba[..., :3] = rows[::-1]
        image = self.bpy.data.images.new("sky", rows.shape[1], rows.shape[0], float_buffer=True)
        image.colorspace_settings.name = "Linear Rec.709"
        image.pixels.foreach_set(rgba.ravel())
        world = self.bpy.data.worlds.new("sky")
        world.use_nodes = True
        node = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        node.image = image
        world.node_tree.links.new(node.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])
        self.bpy.context.scene.world = world

    def set_up(self, size):
        scene = self.bpy.context.scene
        scene.render.engine = "CYCLES"
        scene.render.resolution_x = scene.render.resolution_y = size
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        cycles = scene.cycles
        cycles.device, cycles.use_denoising, cycles.use_adaptive_sampling = "CPU", False, False
        cycles.pixel_filter_type, cycles.sample_clamp_indirect, cycles.blur_glossy = "BOX", 0, 0
        cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = DEPTH
        cycles.transmission_bounces = DEPTH

    def run(self, seed, spp):
        """A picture, and the CPU time of this process in seconds."""
        scene = self.bpy.context.scene
        scene.cycles.seed, scene.cycles.samples = seed, spp
        out = self.folder / "cycles.exr"
        scene.render.filepath = str(out)
        begin = time.process_time()
        self.bpy.ops.render.render(write_still=True)
        spent = time.process_time() - begin
        return self.pixels(out), spent

    def pixels(self, file):
        """As they are stored, from the top."""
        image = self.bpy.data.images.load(str(file))
        image.colorspace_settings.name = "Non-Color"
        width, height = image.size
        rgba = numpy.empty(4 * width * height, "float32")
        image.pixels.foreach_get(rgba)
        self.bpy.data.images.remove(image)
        return rgba.reshape(height, width, 4)[::-1, :, :3]
