"""A scene with a square, and documents. Without Blender nothing is tested: then pytest ends with 77."""

import os
import sys

import pytest

try:
    import bpy
except ImportError:
    bpy = None


def pytest_cmdline_main(config):
    if bpy is not None:
        return None
    print("skipped: there is no Blender (pip install bpy)")
    config.ended = 77
    return 77


def pytest_sessionfinish(session, exitstatus):
    session.config.ended = exitstatus


def pytest_unconfigure(config):
    """Blender as a module may wait for a thread of its own for ever, at its end."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(int(getattr(config, "ended", 1)))


def document(shader, graph="", model="standard_surface"):
    return f"""<materialx version="1.39" colorspace="lin_rec709"><nodegraph name="G">{graph}</nodegraph>
      <{model} name="S" type="surfaceshader">{shader}</{model}>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>"""


# Red grows with u, green with v.
RAMPS = """<ramplr name="red" type="color3"><input name="valuer" type="color3" value="0.8, 0, 0"/></ramplr>
  <ramptb name="green" type="color3"><input name="valuet" type="color3" value="0, 0.8, 0"/></ramptb>
  <add name="both" type="color3"><input name="in1" type="color3" nodename="red"/>
    <input name="in2" type="color3" nodename="green"/></add>
  <output name="color" type="color3" nodename="both"/>
  <extract name="roughness" type="float"><input name="in" type="color3" nodename="red"/></extract>
  <output name="rough" type="float" nodename="roughness"/>
  <constant name="tilt" type="vector3"><input name="value" type="vector3" value="0.6, 0.5, 0.9"/></constant>
  <multiply name="encoded" type="vector3"><input name="in1" type="vector3" nodename="tilt"/>
    <input name="in2" type="float" nodename="roughness"/></multiply>
  <normalmap name="direction" type="vector3"><input name="in" type="vector3" nodename="encoded"/></normalmap>
  <output name="normal" type="vector3" nodename="direction"/>"""


def port(name, kind, output):
    return f'<input name="{name}" type="{kind}" nodegraph="G" output="{output}"/>'


TEXTS = {
    "ramps": document(port("base_color", "color3", "color")
                      + port("specular_roughness", "float", "rough")
                      + port("normal", "vector3", "normal"), RAMPS),
    # What scatters all light by itself: no gloss.
    "paper": document(port("base_color", "color3", "color")
                      + '<input name="specular" type="float" value="0"/>', RAMPS),
    "glass": document("""<input name="transmission" type="float" value="1"/>
      <input name="transmission_color" type="color3" value="0.9, 0.8, 0.5"/>
      <input name="specular_IOR" type="float" value="1.7"/>"""),
    "odd": document("""<input name="coat_affect_color" type="float" value="0.5"/>
      <input name="coat_affect_roughness" type="float" value="0"/>"""),
    "open_pbr": document("""<input name="fuzz_weight" type="float" value="0.5"/>
      <input name="specular_roughness_anisotropy" type="float" value="0.45"/>
      <input name="thin_film_weight" type="float" value="1"/>
      <input name="thin_film_thickness" type="float" value="0.4"/>""", model="open_pbr_surface"),
    "usd": document("""<input name="diffuseColor" type="color3" value="0.1, 0.2, 0.3"/>
      <input name="emissiveColor" type="color3" value="0, 2, 0"/>
      <input name="opacity" type="float" value="0.25"/>""", model="UsdPreviewSurface"),
    "gltf": document("""<input name="metallic" type="float" value="0"/>
      <input name="sheen_color" type="color3" value="0.1, 0.2, 0.3"/>""", model="gltf_pbr"),
    "al": document("", model="alSurface"),
}


@pytest.fixture(scope="session")
def files(tmp_path_factory):
    """Names of documents to their files."""
    folder = tmp_path_factory.mktemp("documents")
    for name, text in TEXTS.items():
        (folder / f"{name}.mtlx").write_text(text)
    return {name: str(folder / f"{name}.mtlx") for name in TEXTS}


@pytest.fixture
def square():
    """From (-1, -1, 0) to (1, 1, 0), in an empty scene; u goes along x, v along y."""
    import nacre_bake

    bpy.ops.wm.read_factory_settings(use_empty=True)
    nacre_bake.register()
    bpy.ops.mesh.primitive_plane_add(size=2)
    yield bpy.context.object
    nacre_bake.unregister()


def principled(material):
    return next(each for each in material.node_tree.nodes if each.type == "BSDF_PRINCIPLED")


def image_behind(socket):
    """Of what a socket is linked to, through nodes that have one link."""
    while socket.is_linked:
        node = socket.links[0].from_node
        if node.type == "TEX_IMAGE":
            return node.image
        socket = next(each for each in node.inputs if each.is_linked)
    return None
