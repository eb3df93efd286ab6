"""Pictures: bake in memory, and what the program writes and says."""

import pathlib

import nacre
import numpy
import pytest

ROOT = pathlib.Path(__file__).parents[4]
MARBLE = ROOT / "examples" / "documents" / "marble.mtlx"

RAMP = """<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <output name="ramp" type="vector2" nodename="uv"/>
  <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
  <output name="u_alone" type="float" nodename="u"/>
  <time name="now" type="float"/>
  <output name="seconds" type="float" nodename="now"/>
</materialx>"""


def test_the_first_row_is_the_uppermost():
    baked = nacre.bake(nacre.Document.parse(RAMP), ["ramp", "u_alone"], size=(4, 2))
    assert baked["ramp"].shape == (2, 4, 2) and baked["u_alone"].shape == (2, 4)
    assert baked["ramp"].dtype == numpy.float32
    u = [0.125, 0.375, 0.625, 0.875]
    assert baked["u_alone"].tolist() == [u, u]
    assert baked["ramp"][:, 0, 1].tolist() == [0.75, 0.25]


def test_values_are_set():
    document = nacre.Document.parse(RAMP)
    assert (nacre.bake(document, ["seconds"], size=2)["seconds"] == 0).all()
    assert (nacre.bake(document, ["seconds"], size=2, values={"time": 2.5})["seconds"] == 2.5).all()


def test_are_those_of_the_program(tmp_path):
    """`nacre bake` writes what bake gives, rounded to bytes: roughness is linear in files."""
    image = pytest.importorskip("matplotlib.image")
    files = nacre.bake_files(MARBLE, out=tmp_path, output=["NG_marble/roughness"], size=(24, 16),
                             format="png", no_cache=True)
    assert [each.suffix for each in files] == [".png"] and files[0].is_file()
    written = image.imread(files[0])
    written = written if written.ndim == 2 else written[..., 0]
    baked = nacre.bake(nacre.Document(MARBLE), ["NG_marble/roughness"], size=(24, 16))
    numpy.testing.assert_allclose(written, baked["NG_marble/roughness"], atol=0.51 / 255)


def test_render_writes_a_picture(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    picture = nacre.render(MARBLE, out=tmp_path / "marble.png", size=(24, 16), spp=1, no_cache=True)
    pixels = image.imread(picture)
    assert pixels.shape[:2] == (16, 24)
    assert pixels[..., :3].std() > 0.01


def test_inspect_says_what_kernels_need():
    said = nacre.inspect(MARBLE, output=["NG_marble/roughness"], no_cache=True)
    assert [each["output"] for each in said] == ["NG_marble/roughness"]
    shader = nacre.default_system().compile_outputs(
        nacre.Document(MARBLE), ["NG_marble/roughness"])
    assert {each["name"] for each in said[0]["kernel"]["inputs"]} == {
        each.name for each in shader.inputs(nacre.Entry.OUTPUTS)}


def test_what_the_program_says_is_an_error(tmp_path):
    broken = tmp_path / "broken.mtlx"
    broken.write_text('<materialx version="1.39">\n<mix name="m"')
    with pytest.raises(nacre.Error) as caught:
        nacre.inspect(broken)
    first = caught.value.diagnostics[0]
    with pytest.raises(nacre.Error) as read:
        nacre.Document(broken)
    same = read.value.diagnostics[0]  # The library's own, which no line was parsed for.
    assert (first.code, first.line, first.column, first.message, first.expected, first.found) == (
        same.code, same.line, same.column, same.message, same.expected, same.found)
    assert first.file == str(broken)


@pytest.mark.parametrize("run", [nacre.inspect, nacre.render])  # As objects, and as lines.
def test_what_was_meant_is_said(run, tmp_path):
    more = {"out": tmp_path / "a.png"} if run is nacre.render else {}
    with pytest.raises(nacre.Error) as caught:
        run(MARBLE, material="marble", no_cache=True, **more)
    said = [each for each in caught.value.diagnostics if each.hint]
    assert [each.hint for each in said] == ["it differs only in case from 'Marble'"]
    assert said[0].code in ("unknown-request", "unknown-material") and str(said[0]).endswith(
        f"; {said[0].hint} [{said[0].code}]" + (f" ({said[0].path})" if said[0].path else ""))


def test_what_the_program_warns_of_is_a_warning(tmp_path):
    text = """<materialx version="1.39">
      <image name="I" type="color3"><input name="file" type="filename" value="none.png"/></image>
      <output name="out" type="color3" nodename="I"/></materialx>"""
    file = tmp_path / "image.mtlx"
    file.write_text(text)
    with pytest.raises(nacre.Error):
        nacre.inspect(file, no_cache=True)
    with pytest.warns(nacre.DiagnosticWarning) as heard:
        nacre.inspect(file, missing_images="default", no_cache=True)
    assert heard[0].message.diagnostic.path == "I"


def test_options_that_the_program_lacks_are_refused():
    with pytest.raises(TypeError, match="sise"):
        nacre.inspect(MARBLE, sise=3)


def test_a_program_that_is_not_there(monkeypatch, tmp_path):
    monkeypatch.setenv("NACRE_TOOL", str(tmp_path / "none"))
    with pytest.raises(FileNotFoundError, match="NACRE_TOOL"):
        nacre.inspect(MARBLE)


def test_lobes_are_checked(tmp_path, documents):
    file = tmp_path / "lambert.mtlx"
    file.write_text(documents["lambert"])
    found, = nacre.check_lobes(file, samples=10_000, no_cache=True)
    assert found["material"] == "M" and found["faults"] == []
    with pytest.raises(nacre.Error):  # More than nothing leaves.
        nacre.check_lobes(file, samples=10_000, most_energy=0.1, no_cache=True)


def test_what_tune_chooses_is_compiled(tmp_path):
    profile = tmp_path / "profile.json"
    found, = nacre.tune(MARBLE, output=["NG_marble/roughness"], max_error=0.05, profile=profile,
                        no_times=True, no_cache=True)
    assert found["output"] == "NG_marble/roughness"
    assert found["chosen"]["unseen_error"]["p999"] <= 0.05
    assert found["chosen"]["cost"] <= found["standard"]["cost"]
    shader = nacre.default_system().compile_outputs(
        nacre.Document(MARBLE), ["NG_marble/roughness"], profile=profile.read_text())
    assert shader.inputs(nacre.Entry.OUTPUTS)
    with pytest.raises(nacre.Error):
        nacre.tune(MARBLE, output=["nothing"], no_cache=True)
