"""Closures against those of Mitsuba 3 where the models are the same.

usage: mitsuba_peer.py FOLDER

Installs Mitsuba from PyPI into FOLDER, once; 77 where that cannot be had. What differs on purpose
is left out: Mitsuba brings nothing back of what facets lose to several scatterings, and multiplies
masking by shadowing. Densities, Fresnel's factors, and fibres are the same.
"""

import importlib
import pathlib
import subprocess
import sys

import nacre
import numpy

MITSUBA = "mitsuba==3.9.1"
SKIPPED = 77
COUNT = 400


def import_mitsuba(folder: pathlib.Path):
    sys.path.insert(0, str(folder))
    try:
        import mitsuba
    except ImportError:
        command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet",
                   "--target", str(folder), "--no-deps", MITSUBA, "drjit==1.5.0"]
        if subprocess.run(command, check=False).returncode != 0:
            print("skipped: Mitsuba cannot be had")
            sys.exit(SKIPPED)
        importlib.invalidate_caches()  # The folder was not there when it was looked for.
        import mitsuba
    mitsuba.set_variant("scalar_rgb")
    return mitsuba


def kernels(system, nodes):
    document = nacre.Document.parse(f"""<materialx version="1.39">{nodes}
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
      </materialx>""")
    return system.compile_material(document, "M", no_footprints=True, accuracy="precise")


def closure(category, **inputs):
    types = {str: "string", float: "float"}
    lines = []
    for name, value in inputs.items():
        if isinstance(value, tuple):
            kind = {2: "vector2", 3: "color3"}[len(value)]
            value = ", ".join(map(str, value))
        else:
            kind = types[type(value)]
        if name == "absorption_coefficient":
            kind = "vector3"
        lines.append(f'<input name="{name}" type="{kind}" value="{value}"/>')
    return f'<{category} name="b" type="BSDF">{"".join(lines)}</{category}>'


def sphere(seed):
    random = numpy.random.default_rng(seed)
    w = random.normal(size=(COUNT, 3))
    return (w / numpy.linalg.norm(w, axis=1, keepdims=True)).astype("float32")


def ours(shader, wo, wi, normal=(0.0, 0.0, 1.0), tangent=(1.0, 0.0, 0.0)):
    points = nacre.surface_points(numpy.zeros_like(wo), normal, wo, T=tangent)
    return shader.run(points | {"wi": wi}, nacre.Entry.EVALUATE)


def report(name, a, b, bound):
    """Of 99 % of the pairs, relative, where one is above a millionth of the largest: at grazing
    angles Mitsuba's half-way vectors lose digits."""
    a, b = numpy.asarray(a, float), numpy.asarray(b, float)
    counts = numpy.maximum(abs(a), abs(b)) > 1e-6 * abs(b).max()
    worst = numpy.quantile(abs(a - b)[counts] / abs(b)[counts].clip(1e-12), 0.99)
    print(f"| {name} | {counts.sum()} | {worst:.1e} | {bound:.0e} |")
    return worst <= bound and counts.sum() >= COUNT / 40


def surface(mi, wo):
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(*map(float, wo))
    si.sh_frame = mi.Frame3f([0, 0, 1])
    si.n = [0, 0, 1]
    si.time = 0
    return si


def densities(mi, system):
    """Of a joint interface: each facet's Fresnel factor, the facets that are seen, the Jacobian."""
    # Mitsuba takes Walter's rational fit for Beckmann's masking, which is within 0.35 %.
    for distribution, bound in (("ggx", 5e-4), ("beckmann", 8e-3)):
        for alpha in (0.1, 0.3, 0.7):
            for index in (1.2, 1.5, 2.4):
                bsdf = mi.load_dict({"type": "roughdielectric", "distribution": distribution,
                                     "alpha": alpha, "int_ior": index, "ext_ior": 1.0})
                category = "dielectricrtdf"
                nodes = f"""<nodedef name="ND_{category}" node="{category}">
                  <input name="distribution" type="string" value="ggx" enum="ggx,beckmann" uniform="true"/>
                  <output name="out" type="BSDF"/></nodedef>
                  <nodegraph name="NG_{category}" nodedef="ND_{category}">
                  <dielectric_bsdf name="d" type="BSDF">
                  <input name="ior" type="float" value="{index}"/>
                  <input name="roughness" type="vector2" value="{alpha}, {alpha}"/>
                  <input name="distribution" type="string" interfacename="distribution"/>
                  <input name="scatter_mode" type="string" value="RT"/></dielectric_bsdf>
                  <output name="out" type="BSDF" nodename="d"/></nodegraph>"""
                shader = kernels(system, nodes + closure(category, distribution=distribution))
                wo, wi = sphere(1), sphere(2)
                context = mi.BSDFContext()
                theirs = [bsdf.pdf(context, surface(mi, o), mi.Vector3f(*map(float, i)))
                          for o, i in zip(wo, wi)]
                yield report(f"density, {distribution}, alpha {alpha}, index {index}",
                             ours(shader, wo, wi)["pdf"], theirs, bound)


def fresnel(mi, system):
    cosines = numpy.linspace(0.01, 1, COUNT).astype("float32")
    wo = numpy.stack([numpy.sqrt(1 - cosines**2), 0 * cosines, cosines], 1).astype("float32")
    points = nacre.surface_points(numpy.zeros_like(wo), (0.0, 0.0, 1.0), wo, T=(1.0, 0.0, 0.0))
    for index in (1.1, 1.5, 2.4):
        shader = kernels(system, closure("dielectric_bsdf", ior=index, roughness=(0.0, 0.0)))
        albedo = shader.run(points, nacre.Entry.ALBEDO)["albedo"][:, 0]
        theirs = [mi.fresnel(float(c), index)[0] for c in cosines]
        yield report(f"Fresnel, index {index}", albedo, theirs, 2e-5)
    for n, k in ((0.2, 3.9), (1.5, 7.6), (2.9, 3.1)):
        shader = kernels(system, closure("conductor_bsdf", ior=(n, n, n), extinction=(k, k, k),
                                         roughness=(0.0, 0.0)))
        albedo = shader.run(points, nacre.Entry.ALBEDO)["albedo"][:, 0]
        theirs = [mi.fresnel_conductor(float(c), mi.Complex2f(n, k)) for c in cosines]
        yield report(f"Fresnel, index {n} + {k} i", albedo, theirs, 2e-5)


def fibres(mi, system):
    """Chiang et al. 2016 on both sides. Mitsuba's fibre lies along y; both take the offset
    from the normal."""
    beta_m, beta_n, index, sigma = 0.4, 0.5, 1.55, (0.2, 0.5, 1.0)
    bsdf = mi.load_dict({"type": "hair", "longitudinal_roughness": beta_m,
                         "azimuthal_roughness": beta_n, "scale_tilt": 0.0, "int_ior": index,
                         "ext_ior": 1.0, "sigma_a": {"type": "rgb", "value": list(sigma)}})
    v = (0.726 * beta_m + 0.812 * beta_m**2 + 3.7 * beta_m**20) ** 2
    s = 0.265 * beta_n + 1.194 * beta_n**2 + 5.372 * beta_n**22
    nodes = closure("chiang_hair_bsdf", ior=index, roughness_R=(v, s), roughness_TT=(v / 4, s),
                    roughness_TRT=(4 * v, s), cuticle_angle=0.5, absorption_coefficient=sigma)
    shader = kernels(system, nodes)
    context = mi.BSDFContext()
    wo, wi = sphere(3), sphere(4)
    wo[:, 2] = abs(wo[:, 2])
    theirs = [[value[c] for c in range(3)]
              for value in (bsdf.eval(context, surface(mi, o), mi.Vector3f(*map(float, i)))
                            for o, i in zip(wo, wi))]
    f = ours(shader, wo, wi, tangent=(0.0, 1.0, 0.0))["f"]
    yield report("fibre", f, theirs, 2e-2)


def main() -> int:
    mi = import_mitsuba(pathlib.Path(sys.argv[1]))
    system = nacre.System()
    print("| what | pairs | relative difference | bound |\n|---|---|---|---|")
    results = [same for peer in (fresnel, densities, fibres) for same in peer(mi, system)]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
