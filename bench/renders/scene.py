"""What is rendered: a ball on a floor under an image of a sky with a sun, y up."""

import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
import gltf_scene  # noqa: E402: the folder is found by then.

POSITION, TARGET, YFOV = [0.0, 2.2, 4.6], [0.0, 0.95, 0.0], 0.6
DEPTH = 8  # Scattering events on a path.
FLOOR = 0.5
SKY_SIZE = 1024, 512
GOLD = {"eta": (0.143, 0.375, 1.442), "k": (3.983, 2.386, 1.603)}
COLOR = (0.8, 0.4, 0.2)
# What the ball is of; each renderer says what it makes of it. How far its mean in Mitsuba's picture
# may be from ours: plastic is no same model there.
SUBJECTS = {"gold, roughness .3": 0.01, "plastic, roughness .3": 0.05, "glass, smooth": 0.01,
            "glass, roughness .2": 0.01}


def sky():
    """(height, width, 3): brighter to the horizon, a sun of 4 degrees, the dim ground. The middle is -z,
    the left quarter -x."""
    width, height = SKY_SIZE
    v, u = numpy.mgrid[0:height, 0:width]
    polar, around = (v + 0.5) / height * numpy.pi, ((u + 0.5) / width - 0.5) * 2 * numpy.pi
    up = numpy.cos(polar)
    toward = numpy.stack([numpy.sin(polar) * numpy.sin(around), up, -numpy.sin(polar) * numpy.cos(around)])
    sun = numpy.array([0.55, 0.6, 0.58])
    angle = numpy.arccos(numpy.clip(numpy.tensordot(sun / numpy.linalg.norm(sun), toward, 1), -1, 1))
    light = numpy.where(up > 0, 0.3 + 0.7 * numpy.exp(-4 * up), 0.15)[..., None] * [0.7, 0.85, 1.0]
    return (light + numpy.clip((numpy.radians(5) - angle) / numpy.radians(2), 0, 1)[..., None]
            * [260.0, 240.0, 200.0]).astype(numpy.float32)


def geometry():
    """Positions, normals and triangles by name."""
    positions, normals, triangles = gltf_scene.ball(1.0, 96)
    ball = [[x, y + 1, z] for x, y, z in positions], normals, triangles
    floor = gltf_scene.quad([-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0])[:3]
    return {"ball": ball, "floor": floor}
