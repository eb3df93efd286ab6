"""Shading points as mappings that Shader.run and Shader.bind take."""

from collections.abc import Mapping
from typing import Any

import numpy

_ZERO = (0.0, 0.0, 0.0)


def surface_points(P: Any, N: Any, wo: Any, *, T: Any = None, uv0: Any = None) -> dict[str, Any]:
    """Points of a surface that has no transformation: object space is world space, the geometric
    normal is N, and footprints are points. Each of P, N, wo and T is (count, 3) or the same for
    all; uv0 is (count, 2). T, the tangent along u, is made perpendicular to N where there is none.
    Only the bitangent is computed, and T if it must be; all else refers to the arguments."""
    if T is None:
        T = _perpendicular(N)
    B = numpy.cross(numpy.asarray(N, "float32"), numpy.asarray(T, "float32"))
    points = {"P": P, "Po": P, "N": N, "No": N, "Ng": N, "T": T, "To": T, "B": B, "Bo": B,
              "wo": wo}
    points |= {name: _ZERO for name in ("dPdx", "dPdy", "dPodx", "dPody")}
    if uv0 is not None:
        points |= {"uv0": uv0, "duv0dx": (0.0, 0.0), "duv0dy": (0.0, 0.0)}
    return points


def plane_points(width: int, height: int) -> dict[str, Any]:
    """The middles of a picture's texels on the plane that `nacre bake` shades: P is (u, v, 0) and
    uv0 (u, v), with (0, 0) the lower left and the first row the uppermost; the viewer is straight
    above; footprints are texels. P is of shape (height, width, 3)."""
    one, half = numpy.float32(1), numpy.float32(0.5)
    P = numpy.zeros((height, width, 3), "float32")
    P[..., 0] = (numpy.arange(width, dtype="float32") + half) * (one / numpy.float32(width))
    down = (numpy.arange(height, dtype="float32") + half) * (one / numpy.float32(height))
    P[..., 1] = (one - down)[:, None]
    up, right = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    points = surface_points(P, up, up, T=right, uv0=P[..., :2])
    points |= {name: (1 / width, 0.0, 0.0) for name in ("dPdx", "dPodx")}
    points |= {name: (0.0, -1 / height, 0.0) for name in ("dPdy", "dPody")}
    return points | {"duv0dx": (1 / width, 0.0), "duv0dy": (0.0, -1 / height)}


def texture_sets(points: Mapping[str, Any], channels: list[str]) -> dict[str, Any]:
    """Further sets of texture coordinates that channels name, the same as uv0; and zeros for the
    vertex colours."""
    more: dict[str, Any] = {}
    for channel in channels:
        group = channel.rpartition(".")[0]
        digits = "".join(c for c in group if c.isdigit())
        alike = group.replace(digits, "0") if digits else group
        if group in points or not digits:
            continue
        if alike in points:
            more[group] = points[alike]
        elif alike == "color0":
            more[group] = (0.0, 0.0, 0.0, 0.0)
    return more


def _perpendicular(N: Any) -> Any:
    normal = numpy.asarray(N, "float32")
    axis = numpy.where(numpy.abs(normal[..., 1:2]) < 0.9, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    tangent = numpy.cross(axis, normal)
    return (tangent / numpy.linalg.norm(tangent, axis=-1, keepdims=True)).astype("float32")
