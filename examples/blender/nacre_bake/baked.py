"""What `nacre bake --document` wrote: a shading model's inputs, each a value or a texture."""

import pathlib
import xml.etree.ElementTree as ElementTree
from typing import NamedTuple

import nacre

Value = tuple[float, ...]


class Texture(NamedTuple):
    file: pathlib.Path
    colorspace: str  # MaterialX's name; "": numbers that are no colour.
    is_direction: bool  # Encoded as normal maps are.


class Shader(NamedTuple):
    model: str  # "standard_surface"
    inputs: dict[str, Value | Texture]  # Those that the document has, and the defaults of others.
    set_inputs: set[str]  # That have no default's value.
    displaces: bool


def read(document: pathlib.Path, material: str) -> Shader:
    """Of a material of such a document. ValueError for what none of those has."""
    root = ElementTree.parse(document).getroot()
    node = _named(root, "surfacematerial", material)
    connected = {each.get("name"): each.get("nodename") for each in node.iter("input")}
    surface = next((each for each in root if each.get("name") == connected.get("surfaceshader")), None)
    if surface is None:
        raise ValueError(f"{document}: material {material!r} has no surface shader")
    inputs = _defaults(surface.tag, surface.get("version"))
    were = dict(inputs)
    for each in surface.iter("input"):
        inputs[each.get("name")] = _source(root, each, document)
    set_inputs = {name for name, source in inputs.items() if were.get(name) != source}
    return Shader(surface.tag, inputs, set_inputs, "displacementshader" in connected)


def _named(parent, tag, name):
    for each in parent.iter(tag):
        if each.get("name") == name:
            return each
    raise ValueError(f"there is no <{tag}> {name!r}")


def _source(root, port, document) -> Value | Texture:
    graph = port.get("nodegraph")
    if graph is None:
        return _value(port)
    graph = _named(root, "nodegraph", graph)
    node = _feeding(graph, _named(graph, "output", port.get("output")))
    is_direction = node.tag == "normalmap"
    if is_direction:
        node = _feeding(graph, _named(node, "input", "in"))
    if node.tag != "image":
        raise ValueError(f"{document}: {port.get('name')!r} is fed by <{node.tag}>, not by an image")
    file = _named(node, "input", "file")
    return Texture(document.parent / file.get("value"), file.get("colorspace", ""), is_direction)


def _feeding(graph, port):
    return next(each for each in graph if each.get("name") == port.get("nodename"))


def _value(port) -> Value:
    text = port.get("value")
    if text is None:
        return ()  # What only geometry gives.
    if port.get("type") == "boolean":
        return (float(text == "true"),)
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        return ()  # A text.


def _defaults(model: str, version: str | None) -> dict[str, Value]:
    """Of the data library's nodedef, and those that it inherits from."""
    found = {}
    for file in sorted((pathlib.Path(nacre.data_library()) / "bxdf").glob("*.mtlx")):
        for each in ElementTree.parse(file).getroot().iter("nodedef"):
            found[each.get("name")] = each
    of_model = [each for each in found.values() if each.get("node") == model]
    chosen = [each for each in of_model if each.get("version") == version] if version else [
        each for each in of_model if each.get("isdefaultversion") == "true"]
    definition, inputs = (chosen or of_model or [None])[0], {}
    while definition is not None:
        inputs = {each.get("name"): _value(each) for each in definition.iter("input")} | inputs
        definition = found.get(definition.get("inherit"))
    return inputs
