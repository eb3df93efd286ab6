"""One scene for two renderers: a ball on a floor under a square lamp and an even sky.

`write` gives it to `nacre render`, `load` to Mitsuba: the same triangles, camera and light, and the
material of a document on the ball.
"""

import pathlib
import sys
import xml.sax.saxutils

import mitsuba as mi
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, ball, quad  # noqa: E402: the folder above is found by then.

POSITION, TARGET, YFOV = [0.0, 2.2, 4.6], [0.0, 0.95, 0.0], 0.6
FLOOR, LAMP, SKY = 0.5, (22.0, 20.0, 17.0), 0.4  # Reflectance, radiance, radiance.
DEPTH = 24  # Scattering events on a path: glass takes some.


def meshes(steps=96):
    """Positions, normals, triangles and uv by name; v goes down, as glTF has it and Mitsuba."""
    positions, normals, triangles = ball(1.0, steps)
    positions = [[x, y + 1, z] for x, y, z in positions]
    uv = [[1 - j / (2 * steps), i / steps] for i in range(steps + 1) for j in range(2 * steps + 1)]
    floor = quad([-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0])
    lamp = quad([-2.6, 4.0, 2.2], [0.0, 0.0, -1.4], [1.4, 0.0, 0.0])
    return {"ball": (positions, normals, triangles, uv), "floor": floor, "lamp": lamp}


def write(folder, document, material):
    """scene.mtlx, scene.gltf and sky.exr; says what `nacre.render` takes: a file and options."""
    scene = Scene("examples/mitsuba/ball.py", (material, "floor", "lamp"))
    for index, (name, (positions, normals, triangles, uv)) in enumerate(meshes().items()):
        scene.node(name=name, mesh=scene.mesh(positions, normals, triangles, index, uv))
    scene.look_at(POSITION, TARGET, YFOV)
    scene.write(folder / "scene.gltf")
    included = xml.sax.saxutils.quoteattr(pathlib.Path(document).name)
    (folder / "scene.mtlx").write_text(f"""<materialx version="1.39"
        xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href={included}/>
      <oren_nayar_diffuse_bsdf name="floor_bsdf" type="BSDF">
        <input name="color" type="color3" value="{FLOOR}, {FLOOR}, {FLOOR}"/>
      </oren_nayar_diffuse_bsdf>
      <surface name="floor_surface" type="surfaceshader">
        <input name="bsdf" type="BSDF" nodename="floor_bsdf"/></surface>
      <surfacematerial name="floor" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="floor_surface"/></surfacematerial>
      <uniform_edf name="lamp_edf" type="EDF">
        <input name="color" type="color3" value="{', '.join(map(str, LAMP))}"/></uniform_edf>
      <light name="lamp_light" type="lightshader">
        <input name="edf" type="EDF" nodename="lamp_edf"/></light>
      <lightmaterial name="lamp" type="material">
        <input name="lightshader" type="lightshader" nodename="lamp_light"/></lightmaterial>
    </materialx>""", encoding="utf-8")
    mi.Bitmap(numpy.full((1, 1, 3), SKY, "float32")).write(str(folder / "sky.exr"))
    return folder / "scene.mtlx", {"scene": folder / "scene.gltf", "max_depth": DEPTH,
                                   "environment": folder / "sky.exr", "quiet": True,
                                   "search_path": [pathlib.Path(document).resolve().parent]}


def mesh(name, bsdf, emitter=None):
    """A mesh of Mitsuba's."""
    props = mi.Properties()
    props["mesh_bsdf"] = mi.load_dict(bsdf)
    if emitter is not None:
        props["mesh_emitter"] = mi.load_dict(emitter)
    positions, normals, triangles, uv = meshes()[name]
    made = mi.Mesh(name, len(positions), len(triangles), has_vertex_normals=True,
                   has_vertex_texcoords=True, props=props)
    parameters = mi.traverse(made)
    for key, rows in (("vertex_positions", positions), ("vertex_normals", normals),
                      ("vertex_texcoords", uv)):
        parameters[key] = mi.Float(numpy.ravel(numpy.float32(rows)))
    parameters["faces"] = mi.UInt32(numpy.ravel(numpy.uint32(triangles)))
    parameters.update()
    return made


def load(bsdf, size):
    """The scene of Mitsuba's with this description of a BSDF on the ball."""
    diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": FLOOR}}
    emitter = {"type": "area", "radiance": {"type": "rgb", "value": list(LAMP)}}
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": DEPTH + 1},
        "ball": mesh("ball", bsdf),
        "floor": mesh("floor", diffuse),
        "lamp": mesh("lamp", {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0}}, emitter),
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": SKY}},
        "sensor": {"type": "perspective", "fov": float(numpy.degrees(YFOV)), "fov_axis": "y",
                   "to_world": mi.ScalarTransform4f().look_at(POSITION, TARGET, [0, 1, 0]),
                   "sampler": {"type": "independent"},
                   "film": {"type": "hdrfilm", "width": size, "height": size,
                            "rfilter": {"type": "box"}}}})
