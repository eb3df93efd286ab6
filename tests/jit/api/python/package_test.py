"""The package as editors and installers see it."""

import ast
import inspect
import pathlib
import re

import nacre
from nacre import _core

PACKAGE = pathlib.Path(nacre.__file__).parent


def test_everything_public_has_a_docstring():
    for name in nacre.__all__:
        assert inspect.getdoc(getattr(nacre, name)), name
    for kind in (nacre.System, nacre.Document, nacre.Shader, nacre.Binding, nacre.Stop):
        for name, member in inspect.getmembers(kind):
            if name.startswith("_") or name in ("is_set", "lobes"):
                continue
            assert inspect.getdoc(member), f"{kind.__name__}.{name}"


def test_stubs_are_those_of_the_module():
    assert (PACKAGE / "py.typed").is_file()
    stub = ast.parse((PACKAGE / "_core.pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    for name, kind in vars(_core).items():
        if not isinstance(kind, type):
            continue
        members = {node.name for node in ast.walk(classes[name])
                   if isinstance(node, ast.FunctionDef)}
        members |= {node.target.id for node in ast.walk(classes[name])
                    if isinstance(node, ast.AnnAssign)}
        members |= {target.id for node in ast.walk(classes[name]) if isinstance(node, ast.Assign)
                    for target in node.targets}
        for member in vars(kind):
            if not member.startswith("__"):
                assert member in members or issubclass(kind, int), f"{name}.{member}"
    run = next(node for node in classes["Binding"].body
               if isinstance(node, ast.FunctionDef) and node.name == "run")
    assert [each.arg for each in run.args.kwonlyargs] == [
        "points", "instances", "instance", "point", "stop"]


def test_entries_are_those_of_the_header():
    root = pathlib.Path(__file__).parents[4]
    header = (root / "jit/api/include/nacre/nacre.h").read_text()
    for entry in nacre.Entry:
        assert f"NACRE_{entry.name} = {int(entry)}" in header
    assert f"NACRE_ENTRY_COUNT = {len(nacre.Entry)}" in header
    flags = {flag.name: str(int(flag)) for flag in nacre.SampleFlag}
    assert flags == dict(re.findall(r"NACRE_SAMPLE_(\w+) = (\d+)", header))
    for constant in (*nacre.LobeKind, *nacre.Transport):
        assert f"NACRE_{constant.name} = {int(constant)}" in header


def test_options_are_those_of_the_interface():
    assert set(nacre.CompileOptions.__annotations__) == {
        name for name in vars(_core.CompileOptions) if not name.startswith("__")}


def test_the_data_library_is_there():
    assert (pathlib.Path(nacre.data_library()) / "stdlib" / "stdlib_defs.mtlx").is_file()
    assert nacre.__version__.count(".") == 2
