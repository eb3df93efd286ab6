#!/usr/bin/env python3
# %% [markdown]
# # Nacre from Python
#
# A notebook in percent cells, as Jupyter (jupytext), VS Code and Spyder open them, and a script:
#
#     pip install .[examples]
#     python examples/python/tour.py out/tour
#
# It bakes a texture, looks at a BSDF lobe, and renders a sphere, all with NumPy.

# %%
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

import nacre

here = pathlib.Path(__file__).parent
documents = here.parent / "documents"
out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "tour")
size = int(sys.argv[2]) if len(sys.argv) > 2 else 384
out.mkdir(parents=True, exist_ok=True)


def unit(vectors):
    """Vectors of length 1, as float32: arrays are taken as they are, so they must have the type."""
    return np.float32(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def encoded(linear):
    """Linear light for the screen, brights rolled off."""
    return np.clip(1 - np.exp(-1.5 * linear), 0, 1) ** (1 / 2.2)


# %% [markdown]
# ## A document and its outputs
#
# A system has the node definitions, textures and the compiler. What is wrong with a document is an
# exception with file, line and element path.

# %%
system = nacre.System()
marble = nacre.Document(documents / "marble.mtlx")
print("materials:", marble.materials, "outputs:", marble.outputs)

try:
    system.compile_outputs(marble, ["NG_marble/none"])
except nacre.Error as error:
    print("as it should be:", error.diagnostics[0])

# %% [markdown]
# ## Textures
#
# `bake` computes graph outputs on the unit square. Parameters that `live` names can be set without
# compiling again; `parameters.ui` has what an interface shows of them.

# %%
textures = nacre.bake(marble, ["NG_marble/base_color"], size=size, system=system)
veined = nacre.bake(marble, ["NG_marble/base_color"], size=size, system=system,
                    live=["NG_marble/*"],
                    values={"NG_marble/scale": 5.0, "NG_marble/vein_color": (0.3, 0.02, 0.02)})
both = np.hstack([textures["NG_marble/base_color"], veined["NG_marble/base_color"]])
plt.imsave(out / "marble.png", np.clip(both, 0, 1) ** (1 / 2.2))

# %% [markdown]
# ## A lobe
#
# One point and many directions: what is a tuple or of one element is the same for all. Where the
# result has no array, `run` makes one. `f` has the cosine in it, so its polar plot is what a light
# from there adds.

# %%
brass = nacre.Document(documents / "brass.mtlx")
metal = system.compile_material(brass, "Brass", live=["SR_brass/*"], no_footprints=True)
print("lobes:", [lobe.name for lobe in metal.lobes])
print("base colour:", metal.parameters.ui["SR_brass/base_color"])

angles = np.linspace(-np.pi / 2, np.pi / 2, 721)
wi = np.float32(np.stack([np.sin(angles), 0 * angles, np.cos(angles)], axis=1))
look = metal.instance()
figure, axes = plt.subplots(subplot_kw={"projection": "polar"}, figsize=(5, 3.5))
for degrees, anisotropy in (20, 0.6), (50, 0.6), (50, 0.0):
    wo = (float(np.sin(np.radians(-degrees))), 0.0, float(np.cos(np.radians(degrees))))
    point = nacre.surface_points((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), wo, T=(1.0, 0.0, 0.0),
                                 uv0=(0.5, 0.5))
    look["SR_brass/specular_anisotropy"] = anisotropy
    f = metal.run(point | {"wi": wi}, nacre.Entry.EVALUATE, instance=look)["f"]
    axes.plot(angles, f[:, 0], label=f"{degrees}°, anisotropy {anisotropy}")
axes.set(theta_zero_location="N", theta_direction=-1, thetamin=-90, thetamax=90)
axes.yaxis.set_major_locator(plt.MaxNLocator(4))
axes.set_title("Brushed brass: f |cos|, red")
axes.legend(loc="lower center", bbox_to_anchor=(0.5, -0.25), fontsize="small")
figure.savefig(out / "lobe.png", dpi=120, bbox_inches="tight")

# %% [markdown]
# ## A sphere
#
# Points of the sphere that each pixel of a parallel view sees. Structures of arrays, arrays of
# structures, columns, crops: all are bound where they are.

# %%
x, y = np.meshgrid(np.linspace(-1.1, 1.1, size), np.linspace(1.1, -1.1, size))
inside = x**2 + y**2 < 1
x, y = x[inside], y[inside]
N = unit(np.stack([x, y, np.sqrt(1 - x**2 - y**2)], axis=1))
T = unit(np.stack([N[:, 2], 0 * x, -N[:, 0] + 1e-6], axis=1))
uv = np.float32(np.stack([0.5 + np.arctan2(N[:, 0], N[:, 2]) / (2 * np.pi),
                          0.5 + np.arcsin(np.clip(N[:, 1], -1, 1)) / np.pi], axis=1))
points = nacre.surface_points(N, N, (0.0, 0.0, 1.0), T=T, uv0=uv)


def sky(directions):
    """Radiance of a sky with a large sun, and of a floor."""
    up = directions[:, 1:2]
    sun = np.clip(directions @ unit(np.array([-0.5, 0.7, 0.5])), 0, 1)[:, None] ** 60
    light = np.where(up > 0, (0.35, 0.45, 0.65) * (1 - 0.5 * up), (0.16, 0.13, 0.11))
    return light + sun * (14, 12, 9)


# %% [markdown]
# `bind` does the work of `run` once: the arrays, results among them, are kept, and a call costs
# about a microsecond. The state is what `BEGIN` computes of the points, patterns above all, so that
# each sample need not.

# %%
def shaded(document, material, samples=64):
    shader = system.compile_material(document, material, no_footprints=True)
    random = np.random.default_rng(1)
    count = len(x)
    u = np.zeros((count, 3), "float32")
    wi, weight = np.zeros((2, count, 3), "float32")
    state = np.zeros((shader.state_count, count), "float32").T
    arrays = points | {"u": u, "wi": wi, "weight": weight, "state": state}
    binding = shader.bind(arrays, entries=[nacre.Entry.BEGIN, nacre.Entry.SAMPLE])
    binding.run(nacre.Entry.BEGIN)
    light = np.zeros((count, 3))
    for _ in range(samples):
        random.random(out=u, dtype="float32")
        binding.run(nacre.Entry.SAMPLE)
        light += weight * sky(wi)
    picture = np.zeros((size, size, 3))
    picture[inside] = light / samples
    return picture


# %%
spheres = [shaded(marble, "Marble"), shaded(brass, "Brass"),
           shaded(nacre.Document(documents / "velvet.mtlx"), "Velvet")]
backdrop = np.where(inside[..., None], 0, (0.02, 0.02, 0.025))
plt.imsave(out / "sphere.png", encoded(np.hstack([each + backdrop for each in spheres])))
print("pictures:", *sorted(str(each) for each in out.glob("*.png")))
