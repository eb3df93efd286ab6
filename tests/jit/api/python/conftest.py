"""What all tests of the Python module share. PYTHONPATH has the package; ctest sets it."""

import nacre
import pytest


@pytest.fixture(scope="session")
def system():
    return nacre.System()


@pytest.fixture(scope="session")
def twice(system):
    """out = 2 uv0, two components."""
    return system.compile_outputs(nacre.Document.parse(DOCUMENTS["twice"]), ["out"])


@pytest.fixture(scope="session")
def lambert(system):
    """A diffuse lobe of albedo (0.25, 0.5, 0.75), whose closed form is color / pi."""
    document = nacre.Document.parse(DOCUMENTS["lambert"])
    return system.compile_material(document, "M", no_footprints=True)


def material(lobe):
    """A document whose material M is a surface of the BSDF "lobe"."""
    return f"""<materialx version="1.39">{lobe}
      <surface name="S" type="surfaceshader">
        <input name="bsdf" type="BSDF" nodename="lobe"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>"""


DOCUMENTS = {
    "twice": """<materialx version="1.39">
      <texcoord name="uv" type="vector2"/>
      <multiply name="twice" type="vector2"><input name="in1" type="vector2" nodename="uv"/>
        <input name="in2" type="float" value="2"/></multiply>
      <output name="out" type="vector2" nodename="twice"/></materialx>""",
    "lambert": material("""<oren_nayar_diffuse_bsdf name="lobe" type="BSDF">
      <input name="color" type="color3" value="0.25, 0.5, 0.75"/></oren_nayar_diffuse_bsdf>"""),
    # Gloss over paper: a choice of lobes hangs on the view.
    "two_lobes": material("""<dielectric_bsdf name="gloss" type="BSDF">
        <input name="roughness" type="vector2" value="0.3, 0.3"/></dielectric_bsdf>
      <oren_nayar_diffuse_bsdf name="paper" type="BSDF"/>
      <layer name="lobe" type="BSDF"><input name="top" type="BSDF" nodename="gloss"/>
        <input name="base" type="BSDF" nodename="paper"/></layer>"""),
    "white_metal": material("""<conductor_bsdf name="lobe" type="BSDF">
      <input name="ior" type="color3" value="0, 0, 0"/>
      <input name="extinction" type="color3" value="1, 1, 1"/>
      <input name="roughness" type="vector2" value="1, 1"/></conductor_bsdf>"""),
    "glass": material("""<dielectric_bsdf name="lobe" type="BSDF">
      <input name="scatter_mode" type="string" value="RT"/>
      <input name="roughness" type="vector2" value="0, 0"/>
      <input name="ior" type="float" value="1.5"/></dielectric_bsdf>"""),
    "painted": """<materialx version="1.39"><image name="i" type="color3">
      <input name="file" type="filename" value="painted"/>
      <input name="filtertype" type="string" value="closest"/></image>
      <output name="out" type="color3" nodename="i"/></materialx>""",
    # One parameter of each kind: out = scale + offset.x where flag, else 0.
    "values": """<materialx version="1.39">
      <constant name="scale" type="float"><input name="value" type="float" value="3" uiname="Scale"
        uifolder="Numbers" uimin="0" uimax="10" doc="How much"/></constant>
      <constant name="offset" type="color3">
        <input name="value" type="color3" value="1, 2, 4"/></constant>
      <constant name="flag" type="boolean">
        <input name="value" type="boolean" value="true"/></constant>
      <constant name="count" type="integer">
        <input name="value" type="integer" value="7"/></constant>
      <extract name="x" type="float"><input name="in" type="color3" nodename="offset"/></extract>
      <add name="sum" type="float"><input name="in1" type="float" nodename="scale"/>
        <input name="in2" type="float" nodename="x"/></add>
      <ifequal name="chosen" type="float"><input name="value1" type="boolean" nodename="flag"/>
        <input name="value2" type="boolean" value="true"/>
        <input name="in1" type="float" nodename="sum"/>
        <input name="in2" type="float" value="0"/></ifequal>
      <output name="out" type="float" nodename="chosen"/>
      <output name="number" type="integer" nodename="count"/></materialx>""",
    # out = the matrix's rows turned; what is stored has 16 components.
    "matrix": """<materialx version="1.39">
      <constant name="m" type="matrix44"><input name="value" type="matrix44"
        value="1,2,3,4, 5,6,7,8, 9,10,11,12, 13,14,15,16"/></constant>
      <transpose name="turned" type="matrix44">
        <input name="in" type="matrix44" nodename="m"/></transpose>
      <output name="out" type="matrix44" nodename="turned"/></materialx>""",
    # Slow, so that there is time to stop it, and of nothing but the position.
    "slow": """<materialx version="1.39">
      <fractal3d name="noise" type="float">
        <input name="octaves" type="integer" value="8"/></fractal3d>
      <output name="out" type="float" nodename="noise"/></materialx>""",
}


@pytest.fixture(scope="session")
def documents():
    return DOCUMENTS


def refused(code, name, *texts):
    """A context in which an Error with that code and name is raised, which says the texts."""
    return _Refused(code, name, texts)


class _Refused:
    def __init__(self, code, name, texts):
        self.code, self.name, self.texts = code, name, texts

    def __enter__(self):
        return self

    def __exit__(self, type_, error, traceback):
        assert type_ is nacre.Error, f"{type_} instead of an Error: {error}"
        first = error.diagnostics[0]
        assert (first.code, first.path) == (self.code, self.name), str(error)
        for text in self.texts:
            assert text in str(error), str(error)
        return True
