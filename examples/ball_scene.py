"""A ball on a floor under a square lamp and an even sky, for other renderers beside `nacre render`.

`write` gives it to `nacre render`, with the material of a document on the ball; `meshes` and the
numbers below to others: the same triangles, camera and light.
"""

import pathlib
import xml.sax.saxutils

from gltf_scene import Scene, ball, quad

POSITION, TARGET, YFOV = [0.0, 2.2, 4.6], [0.0, 0.95, 0.0], 0.6
FLOOR, LAMP, SKY = 0.5, (22.0, 20.0, 17.0), 0.4  # Reflectance, radiance, radiance.
DEPTH = 24  # Scattering events on a path: glass takes some.


def meshes(steps=96):
    """Positions, normals, triangles and uv by name; v goes down, as glTF has it."""
    positions, normals, triangles = ball(1.0, steps)
    positions = [[x, y + 1, z] for x, y, z in positions]
    uv = [[1 - j / (2 * steps), i / steps] for i in range(steps + 1) for j in range(2 * steps + 1)]
    floor = quad([-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0])
    lamp = quad([-2.6, 4.0, 2.2], [0.0, 0.0, -1.4], [1.4, 0.0, 0.0])
    return {"ball": (positions, normals, triangles, uv), "floor": floor, "lamp": lamp}


def write(folder, document, material):
    """scene.mtlx, scene.gltf and sky.tga; says what `nacre.render` takes: a file and options."""
    scene = Scene("examples/ball_scene.py", (material, "floor", "lamp"))
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
    # A header and one pixel, of 8 bits a channel.
    header = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0]
    (folder / "sky.tga").write_bytes(bytes(header + 3 * [round(255 * SKY)]))
    return folder / "scene.mtlx", {"scene": folder / "scene.gltf", "max_depth": DEPTH,
                                   "environment": folder / "sky.tga", "quiet": True,
                                   "search_path": [pathlib.Path(document).resolve().parent]}
