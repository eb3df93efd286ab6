"""Documents, and what is said of them."""

import pathlib
import pickle
import warnings

import nacre
import pytest


def test_lists_materials_and_outputs(documents):
    assert nacre.Document.parse(documents["lambert"]).materials == ["M"]
    values = nacre.Document.parse(documents["values"])
    assert values.materials == []
    assert values.outputs == ["out", "number"]


def test_reads_files_and_includes(tmp_path: pathlib.Path, documents):
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "included.mtlx").write_text(documents["twice"])
    main = tmp_path / "main.mtlx"
    main.write_text('<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">'
                    '<xi:include href="included.mtlx"/></materialx>')
    assert nacre.Document(main, search_paths=[tmp_path / "below"]).outputs == ["out"]
    with pytest.raises(nacre.Error):
        nacre.Document(main)


def including(name):
    return ('<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">'
            f'<xi:include href="{name}"/></materialx>')


def test_a_function_finds_includes_at_paths_and_in_memory(tmp_path, documents):
    (tmp_path / "elsewhere.mtlx").write_text(documents["values"])
    asked = []

    def find(name, named_by, is_image):
        asked.append((name, named_by, is_image))
        return {"packed.mtlx": documents["twice"].encode(),
                "moved.mtlx": tmp_path / "elsewhere.mtlx"}.get(name)

    for name, outputs in (("packed.mtlx", ["out"]), ("moved.mtlx", ["out", "number"])):
        document = nacre.Document.parse(including(name), "main.mtlx", resolver=find)
        assert document.outputs == outputs
    assert asked == [("packed.mtlx", "main.mtlx", False), ("moved.mtlx", "main.mtlx", False)]
    with pytest.raises(nacre.Error):  # None: it is looked for as usual, and is not there.
        nacre.Document.parse(including("none.mtlx"), "main.mtlx", resolver=find)
    assert asked[-1][0] == "none.mtlx"


@pytest.mark.parametrize(("find", "reason"), [
    (lambda *_: {}["key"], "KeyError: 'key'"), (lambda *_: 3, "TypeError"),
    (lambda: None, "TypeError")])
def test_what_a_function_raises_is_said(find, reason):
    with pytest.raises(nacre.Error) as caught:
        nacre.Document.parse(including("a.mtlx"), "main.mtlx", resolver=find)
    assert reason in str(caught.value)


def test_a_resolver_is_a_function(documents):
    with pytest.raises(TypeError):
        nacre.Document.parse(documents["twice"], resolver="archive.zip")
    with pytest.raises(TypeError):
        nacre.System(resolver=3)


def test_error_carries_the_place():
    with pytest.raises(nacre.Error) as caught:
        nacre.Document.parse('<materialx version="1.39"><mix name="m"', "broken.mtlx")
    first = caught.value.diagnostics[0]
    assert first.severity == nacre.Severity.ERROR
    assert (first.file, first.line) == ("broken.mtlx", 1)
    assert str(first) in str(caught.value)
    assert str(first).startswith("broken.mtlx:1")


def test_error_of_a_file_that_is_not_there(tmp_path):
    with pytest.raises(nacre.Error) as caught:
        nacre.Document(tmp_path / "none.mtlx")
    assert caught.value.diagnostics[0].file.endswith("none.mtlx")


def test_error_survives_pickling():
    with pytest.raises(nacre.Error) as caught:
        nacre.Document.parse("<")
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.diagnostics == caught.value.diagnostics
    assert str(again) == str(caught.value)


def test_unknown_names_are_errors(system, documents):
    document = nacre.Document.parse(documents["twice"])
    with pytest.raises(nacre.Error) as caught:
        system.compile_outputs(document, ["nothing"])
    assert "nothing" in str(caught.value)
    with pytest.raises(nacre.Error):
        system.compile_material(document, "nothing")


IMAGE = """<materialx version="1.39">
  <image name="I" type="color3"><input name="file" type="filename" value="none.png"/></image>
  <output name="out" type="color3" nodename="I"/></materialx>"""


def test_warnings_are_pythons(system):
    document = nacre.Document.parse(IMAGE)
    with pytest.raises(nacre.Error) as caught:
        system.compile_outputs(document, ["out"])
    assert caught.value.diagnostics[0].path == "I"
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        shader = system.compile_outputs(document, ["out"], missing_images_pass=True)
    assert shader.has(nacre.Entry.OUTPUTS)
    assert len(heard) == 1
    assert heard[0].category is nacre.DiagnosticWarning
    assert heard[0].filename == __file__  # The caller's line, not one of ours.
    assert heard[0].message.diagnostic.severity == nacre.Severity.WARNING
    assert heard[0].message.diagnostic.path == "I"


def test_warnings_can_be_errors(system):
    with warnings.catch_warnings():
        warnings.simplefilter("error", nacre.DiagnosticWarning)
        with pytest.raises(nacre.DiagnosticWarning):
            system.compile_outputs(nacre.Document.parse(IMAGE), ["out"], missing_images_pass=True)


def test_options_that_are_none_are_refused(system, documents):
    document = nacre.Document.parse(documents["twice"])
    with pytest.raises(TypeError, match="footprint"):
        system.compile_outputs(document, ["out"], footprint=True)
    with pytest.raises(ValueError, match="engine"):
        system.compile_outputs(document, ["out"], engine="gpu")
    with pytest.raises(TypeError):
        system.compile_outputs(document, "out")
    with pytest.raises(TypeError):
        system.compile_outputs(document, ["out"], live="scale")


def test_check_says_what_compiling_would_say(system, documents):
    assert system.check(nacre.Document.parse(documents["twice"])) == []
    document = nacre.Document.parse(IMAGE)
    said = system.check(document)
    with pytest.raises(nacre.Error) as caught:
        system.compile_outputs(document, ["out"])
    assert [each.text for each in said] == [each.text for each in caught.value.diagnostics]
    assert [each.severity for each in system.check(document, missing_images_pass=True)] == [
        nacre.Severity.WARNING]


def test_an_output_space_is_of_colours(system):
    document = nacre.Document.parse(
        """<materialx version="1.39"><constant name="c" type="color3">
             <input name="value" type="color3" value="0.5, 0.5, 0.5"/></constant>
           <output name="out" type="color3" nodename="c"/></materialx>""")
    shader = system.compile_outputs(document, ["out"], output_space="srgb_texture")
    # IEC 61966-2-1: 1.055 x^(1/2.4) - 0.055.
    assert shader.run({}, count=1)["out"] == pytest.approx(0.735357, abs=2e-6)
