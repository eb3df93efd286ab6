"""MaterialX materials in Blender: graphs are baked by Nacre, and textures feed a Principled BSDF.

An add-on for Blender 4.2 and later: zip this folder and install it, with the module `nacre` in
Blender's Python (`BLENDER/4.5/python/bin/python3.11 -m pip install PATH_OF_NACRE`). The panel "Nacre"
is among the properties of materials. In scripts, and with `pip install bpy`:

    import nacre_bake
    nacre_bake.register()
    bpy.ops.nacre.bake_material(filepath="marble.mtlx", folder="textures", size=1024)

or, for a material that is on no object yet,

    material, warnings = nacre_bake.bake_material("marble.mtlx", folder="textures", size=1024)

Shading models that it knows: standard_surface, open_pbr_surface, gltf_pbr, UsdPreviewSurface. What
the Principled BSDF has nothing for is a warning (models.py says what goes where). Textures are of
the unit square of the object's UV map, which graphs of positions are baked on, too.
"""

from .operator import NACRE_OT_bake_material, NACRE_PT_panel, bake_material, register, unregister

bl_info = {
    "name": "Nacre: MaterialX by baking",
    "author": "Nacre",
    "version": (0, 1, 0),
    "blender": (4, 2, 0),
    "location": "Properties > Material > Nacre",
    "description": "Materials of MaterialX documents as Principled BSDFs with baked textures",
    "category": "Material",
}

__all__ = ["NACRE_OT_bake_material", "NACRE_PT_panel", "bake_material", "register", "unregister"]
