"""The nodes of a material: a Principled BSDF, its textures, and what lies between."""

import bpy

from .baked import Shader, Texture, Value
from .models import MODELS, Product

# Of MaterialX to those of Blender's configuration.
SPACES = {"srgb_texture": "sRGB", "lin_rec709": "Linear Rec.709", "": "Non-Color"}

Source = Value | bpy.types.NodeSocket


class Nodes:
    """Makes nodes where numbers do not do."""

    def __init__(self, tree: bpy.types.NodeTree) -> None:
        self.tree = tree
        self.images: dict[Texture, bpy.types.Node] = {}

    def node(self, kind: str, column: int) -> bpy.types.Node:
        made = self.tree.nodes.new(kind)
        rows = sum(1 for each in self.tree.nodes if each.location.x == 300 * column)
        made.location = (300 * column, -300 * rows)
        return made

    def source(self, given: Value | Texture) -> Source:
        if not isinstance(given, Texture):
            return given
        if given in self.images:
            return self.images[given].outputs[0]
        if given.colorspace not in SPACES:
            raise ValueError(f"{given.file}: Blender has no colour space {given.colorspace!r}")
        node = self.node("ShaderNodeTexImage", -4)
        node.image = bpy.data.images.load(str(given.file), check_existing=True)
        node.image.reload()  # It may have been baked again.
        node.image.colorspace_settings.name = SPACES[given.colorspace]
        node.label = given.file.stem
        if given.is_direction:
            normal = self.node("ShaderNodeNormalMap", -2)
            self.tree.links.new(node.outputs["Color"], normal.inputs["Color"])
            node = normal
        self.images[given] = node
        return node.outputs[0]

    def set(self, socket: bpy.types.NodeSocket, source: Source) -> None:
        """A number for a colour is grey; a colour for a number its luminance, as Blender's links do."""
        if isinstance(source, bpy.types.NodeSocket):
            self.tree.links.new(source, socket)
            return
        if socket.type in ("RGBA", "VECTOR"):
            three = source * 3 if len(source) == 1 else source
            socket.default_value = (*three, 1.0) if socket.type == "RGBA" else three
        else:
            socket.default_value = source[0] if len(source) == 1 else _luminance(source)

    def multiply(self, a: Source, b: Source) -> Source:
        return self._mixed("MULTIPLY", a, b, (1.0,))

    def mix(self, a: Source, b: Source, share: Source) -> Source:
        return self._mixed("MIX", a, b, share)

    def _mixed(self, blend: str, a: Source, b: Source, share: Source) -> Source:
        if not any(isinstance(each, bpy.types.NodeSocket) for each in (a, b, share)):
            (a, b), t = _alike(a, b), share[0]
            return tuple(x * y if blend == "MULTIPLY" else x + (y - x) * t for x, y in zip(a, b))
        if blend == "MULTIPLY" and (1.0,) in (a, b):
            return b if a == (1.0,) else a
        if share == (0.0,):
            return a
        node = self.node("ShaderNodeMix", -2)
        node.data_type, node.blend_type, node.clamp_factor = "RGBA", blend, False
        for name, source in ("Factor_Float", share), ("A_Color", a), ("B_Color", b):
            self.set(next(each for each in node.inputs if each.identifier == name), source)
        return next(each for each in node.outputs if each.identifier == "Result_Color")


def build(material: bpy.types.Material, shader: Shader) -> list[str]:
    """Fills a material; says what of the shader is not in it."""
    if shader.model not in MODELS:
        raise ValueError(f"{shader.model} has no way to a Principled BSDF: {', '.join(MODELS)} have")
    model, inputs = MODELS[shader.model], shader.inputs
    material.use_nodes = True
    material.node_tree.nodes.clear()
    nodes = Nodes(material.node_tree)
    output, principled = nodes.node("ShaderNodeOutputMaterial", 1), nodes.node("ShaderNodeBsdfPrincipled", 0)
    material.node_tree.links.new(principled.outputs[0], output.inputs["Surface"])

    def product(of: Product) -> Source:
        result: Source = (of.factor,)
        for name in of.inputs:
            result = nodes.multiply(result, nodes.source(inputs[name]))
        return result

    base = product(model.base)
    if model.subsurface:
        share, color = (nodes.source(inputs[name]) for name in model.subsurface)
        base = nodes.mix(base, color, share)
    if model.transmission:
        share, color = (nodes.source(inputs[name]) for name in model.transmission)
        if share != (0.0,):  # Cycles takes the root at each interface.
            base = nodes.mix(base, nodes.multiply(color, color), share)
    nodes.set(principled.inputs["Base Color"], base)
    used = {*model.base.inputs, *(model.transmission or ()), *(model.subsurface or ()), *model.also}
    lost = []
    for name, of in model.sockets.items():
        used.update(of.inputs)
        is_direction = principled.inputs[name].type == "VECTOR" and name.endswith("Normal")
        if is_direction and not isinstance(inputs[of.inputs[0]], Texture):
            continue  # The surface's.
        if name in ("Anisotropic", "Thin Film Thickness") and product(of) == (0.0,):
            continue
        nodes.set(principled.inputs[name], product(of))
    if principled.inputs["Anisotropic"].is_linked or principled.inputs["Anisotropic"].default_value > 0:
        tangent = nodes.node("ShaderNodeTangent", -1)
        tangent.direction_type = "UV_MAP"
        material.node_tree.links.new(tangent.outputs[0], principled.inputs["Tangent"])
    lost += [f"{shader.model}: the Principled BSDF has nothing for {name!r}"
             for name in sorted(shader.set_inputs - used)]
    if shader.displaces:
        lost.append("displacement is left out")
    return lost


def _alike(a: Value, b: Value) -> tuple[Value, Value]:
    longest = max(len(a), len(b))
    return tuple(each * longest if len(each) == 1 else each for each in (a, b))


def _luminance(color: Value) -> float:
    return sum(x * y for x, y in zip(color, (0.2126, 0.7152, 0.0722)))
