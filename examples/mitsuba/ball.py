"""The scene of ../ball_scene.py in Mitsuba."""

import pathlib
import sys

import mitsuba as mi
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from ball_scene import (  # noqa: E402: the folder above is found by then.
    DEPTH, FLOOR, LAMP, POSITION, SKY, TARGET, YFOV, meshes)


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
