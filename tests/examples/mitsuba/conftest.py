"""Hits on a plane, and documents. Without Mitsuba nothing is tested: then pytest ends with 77."""

import pathlib

import pytest

try:
    import drjit as dr
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")
    dr.eval(dr.arange(mi.Float, 2))
    MISSING = ""
except ImportError:
    MISSING = "there is no Mitsuba (pip install mitsuba)"
except Exception as problem:
    MISSING = f"Mitsuba has no LLVM (DRJIT_LIBLLVM_PATH): {problem}"


def pytest_cmdline_main(config):
    if not MISSING:
        return None
    print(f"skipped: {MISSING}")
    return 77


DOCUMENTS = pathlib.Path(__file__).resolve().parents[3] / "examples" / "documents"


def material(lobes, surface=""):
    return f"""<materialx version="1.39">{lobes}
      <surface name="S" type="surfaceshader">{surface}
        <input name="bsdf" type="BSDF" nodename="lobe"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>"""


def diffuse(r, g, b, surface=""):
    return material(f"""<oren_nayar_diffuse_bsdf name="lobe" type="BSDF">
      <input name="color" type="color3" value="{r}, {g}, {b}"/></oren_nayar_diffuse_bsdf>""", surface)


def glass(roughness):
    return material(f"""<dielectric_bsdf name="lobe" type="BSDF">
      <input name="scatter_mode" type="string" value="RT"/>
      <input name="roughness" type="vector2" value="{roughness}, {roughness}"/>
      <input name="ior" type="float" value="1.5"/></dielectric_bsdf>""")


TEXTS = {
    "diffuse": diffuse(0.25, 0.5, 0.75),
    "white": diffuse(1, 1, 1),
    "half": diffuse(1, 1, 1, '<input name="opacity" type="float" value="0.25"/>'),
    "glass": glass(0),
    "rough_glass": glass(0.3),
    "brushed": material("""<conductor_bsdf name="lobe" type="BSDF">
      <input name="roughness" type="vector2" value="0.2, 0.5"/></conductor_bsdf>"""),
    # A choice of lobes hangs on the view.
    "gloss": material("""<dielectric_bsdf name="top" type="BSDF">
        <input name="roughness" type="vector2" value="0.3, 0.3"/></dielectric_bsdf>
      <oren_nayar_diffuse_bsdf name="paper" type="BSDF"/>
      <layer name="lobe" type="BSDF"><input name="top" type="BSDF" nodename="top"/>
        <input name="base" type="BSDF" nodename="paper"/></layer>"""),
    "glowing": """<materialx version="1.39"><standard_surface name="S" type="surfaceshader">
        <input name="emission" type="float" value="1"/></standard_surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>""",
    "colored": """<materialx version="1.39">
      <geompropvalue name="lobe_color" type="color3"><input name="geomprop" type="string" value="dirt"/>
      </geompropvalue>
      <oren_nayar_diffuse_bsdf name="lobe" type="BSDF">
        <input name="color" type="color3" nodename="lobe_color"/></oren_nayar_diffuse_bsdf>
      <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="lobe"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>""",
}


@pytest.fixture(scope="session")
def files(tmp_path_factory):
    """Names of documents to their files."""
    folder = tmp_path_factory.mktemp("documents")
    for name, text in TEXTS.items():
        (folder / f"{name}.mtlx").write_text(text)
    return {name: str(folder / f"{name}.mtlx") for name in TEXTS}


@pytest.fixture(scope="session")
def bsdf(files):
    """nacre_bsdf of a document by its name."""
    import nacre_mitsuba  # noqa: F401: registers it.

    return lambda name, **more: mi.load_dict({"type": "nacre_bsdf", "filename": files[name], **more})


def hits(count, wi=(0, 0, 1), uv=(0.5, 0.5)):
    """On the plane z = 0, seen along wi."""
    si = dr.zeros(mi.SurfaceInteraction3f, count)
    si.n = mi.Normal3f(0, 0, 1)
    si.sh_frame = mi.Frame3f(mi.Vector3f(1, 0, 0), mi.Vector3f(0, 1, 0), mi.Vector3f(0, 0, 1))
    si.dp_du, si.dp_dv = mi.Vector3f(1, 0, 0), mi.Vector3f(0, -1, 0)
    si.wi, si.uv = dr.normalize(mi.Vector3f(wi)), mi.Point2f(uv)
    si.p = mi.Point3f(si.uv.x, 1 - si.uv.y, 0)
    return si


def sphere_of_directions(count):
    return mi.warp.square_to_uniform_sphere(numbers(count, 5))


def numbers(count, seed):
    """Two random numbers each."""
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    return sampler.next_2d()
