"""What users see: an operator and a panel."""

import os
import pathlib
import warnings

import bpy
import nacre

from . import baked, principled

# What says that a path may begin with //.
_RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set()


def bake_material(document: str | os.PathLike[str], *, folder: str | os.PathLike[str],
                  material: str = "", size: int = 1024, format: str = "png",
                  ) -> tuple[bpy.types.Material, list[str]]:
    """Bakes a material of a MaterialX document ("": its first) into a folder, and makes Blender's
    of it, of the same name; one that there is already is filled anew. Also what was warned about.

    nacre.Error for what cannot be baked, ValueError for what has no way to a Principled BSDF."""
    names = nacre.Document(document).materials
    name = material or (names[0] if names else "")
    if name not in names:
        raise ValueError(f"{document}: material {name!r}; there are: {', '.join(names) or 'none'}")
    folder = pathlib.Path(folder).resolve()
    file = folder / f"{bpy.path.clean_name(name)}.mtlx"
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        nacre.bake_files(document, out=folder, document=file, material=name, size=size, format=format)
    shader = baked.read(file, name)
    made = bpy.data.materials.get(name) or bpy.data.materials.new(name)
    lost = principled.build(made, shader)
    return made, [str(each.message) for each in caught] + lost


class NACRE_OT_bake_material(bpy.types.Operator):
    """Bake a MaterialX material and assign it to the active object"""

    bl_idname = "nacre.bake_material"
    bl_label = "Bake MaterialX Material"
    bl_options = {"REGISTER", "UNDO"}

    filepath: bpy.props.StringProperty(name="Document", subtype="FILE_PATH", options=_RELATIVE)
    filter_glob: bpy.props.StringProperty(default="*.mtlx", options={"HIDDEN"})
    material: bpy.props.StringProperty(name="Material", description="Empty: the first")
    folder: bpy.props.StringProperty(name="Textures", subtype="DIR_PATH", options=_RELATIVE,
                                     description="Where textures are written; // is beside the .blend")
    size: bpy.props.IntProperty(name="Size", default=1024, min=1, max=16384, subtype="PIXEL")
    format: bpy.props.EnumProperty(name="Format", default="png", items=(
        ("png", "PNG", "Whole numbers of 8 bits, from 0 to 1"), ("exr", "EXR", "Floats")))

    @classmethod
    def poll(cls, context):
        return context.object is not None and hasattr(context.object.data, "materials")

    def invoke(self, context, event):
        self.folder = self.folder or "//textures"
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        folder = self.folder or "//textures"
        if folder.startswith("//") and not bpy.data.filepath:
            self.report({"ERROR"}, "textures lie beside the .blend: save it, or name another folder")
            return {"CANCELLED"}
        try:
            made, warned = bake_material(bpy.path.abspath(self.filepath), folder=bpy.path.abspath(folder),
                                         material=self.material, size=self.size, format=self.format)
        except (nacre.Error, OSError, ValueError) as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        for each in warned:
            self.report({"WARNING"}, each)
        if context.object.material_slots:
            context.object.active_material = made
        else:
            context.object.data.materials.append(made)
        return {"FINISHED"}


class NACRE_PT_panel(bpy.types.Panel):
    bl_idname = "NACRE_PT_panel"
    bl_label = "Nacre"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "material"

    def draw(self, context):
        self.layout.operator(NACRE_OT_bake_material.bl_idname, icon="TEXTURE")


def register() -> None:
    for each in NACRE_OT_bake_material, NACRE_PT_panel:
        bpy.utils.register_class(each)


def unregister() -> None:
    for each in NACRE_PT_panel, NACRE_OT_bake_material:
        bpy.utils.unregister_class(each)
