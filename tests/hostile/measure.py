#!/usr/bin/env python3
"""usage: measure.py NACRE [--share N] [--quick | CASE...]

Gives the tool what should not be able to hurt it, and prints what each case took: wall and
processor time, peak memory, exit status and the codes of what was said. --quick leaves out those
that take seconds. Exit status 1 if a case ends other than it should, takes more memory than it may
(N times as much and 512 MB in a build with sanitizers, which keep what was freed), or does not end
within two minutes.
"""

import pathlib
import sys
import tempfile

import images
from outcome import run

MB = 1 << 20
TIMEOUT = 120
ROOT = '<materialx version="1.39">\n%s</materialx>\n'


class Case:
    """`build(folder)` writes the files and returns the document and flags; `codes` must be said,
    nothing else; `megabytes` is what the process may use at most."""

    def __init__(self, build, codes=(), megabytes=256):
        self.build, self.codes, self.megabytes = build, set(codes), megabytes
        self.slow = megabytes > 600


def write(folder, name, text):
    path = folder / name
    data = text if isinstance(text, bytes) else text.encode()
    path.write_bytes(data)
    return path


def document(body, name="a.mtlx"):
    return lambda folder: [write(folder, name, ROOT % (body() if callable(body) else body))]


def nodes(count):
    return "".join(f'<constant name="n{i}" type="float"/>\n' for i in range(count))


def chain(length, outputs):
    lines = ['<constant name="n0" type="float"/>\n']
    for i in range(1, length):
        lines.append(f'<sin name="n{i}" type="float"><input name="in" type="float" nodename="n{i - 1}"/></sin>\n')
    for i in range(outputs):
        lines.append(f'<output name="o{i}" type="float" nodename="n{length - 1 - i}"/>\n')
    return "".join(lines)


def nested_graphs(depth):
    """Each graph hands its interface on to the one inside, up to the depth of XML."""
    head, tail = "", ""
    for i in range(depth):
        source = 'value="0.5"' if i == 0 else 'interfacename="x"'
        head += f'<nodegraph name="g{i}"><input name="x" type="float" {source}/>\n'
        inner = f'nodegraph="g{i + 1}" output="out"' if i + 1 < depth else 'nodename="c"'
        tail = f'<output name="out" type="float" {inner}/></nodegraph>\n' + tail
    leaf = '<constant name="c" type="float"><input name="value" type="float" interfacename="x"/></constant>\n'
    return head + leaf + tail


def doubling_graphs(levels):
    """Node k is a graph of two nodes k-1: 2^levels nodes when all is inlined."""
    lines = []
    for i in range(levels):
        leaf = "constant" if i == 0 else f"d{i - 1}"
        lines.append(f'<nodedef name="ND_d{i}" node="d{i}"><output name="out" type="float"/></nodedef>\n'
                     f'<nodegraph name="NG_d{i}" nodedef="ND_d{i}">'
                     f'<{leaf} name="a" type="float"/><{leaf} name="b" type="float"/>'
                     '<add name="s" type="float"><input name="in1" type="float" nodename="a"/>'
                     '<input name="in2" type="float" nodename="b"/></add>'
                     '<output name="out" type="float" nodename="s"/></nodegraph>\n')
    lines.append(f'<d{levels - 1} name="x" type="float"/><output name="o" type="float" nodename="x"/>\n')
    return "".join(lines)


def include_diamond(levels):
    def build(folder):
        for i in range(levels):
            include = f'<xi:include href="f{i + 1}.mtlx"/>\n'
            write(folder, f"f{i}.mtlx", ROOT % (include * 2))
        write(folder, f"f{levels}.mtlx", ROOT % '<constant name="c" type="float"/>\n')
        return [folder / "f0.mtlx"]
    return build


def entity_bomb():
    entities = '<!ENTITY e0 "lol">\n' + "".join(
        f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">\n' for i in range(1, 12))
    return lambda folder: [write(folder, "a.mtlx", f"<!DOCTYPE materialx [\n{entities}]>\n" +
                                 ROOT.replace("1.39\"", '1.39" doc="&e11;"') % "")]


def raw(text):
    return lambda folder: [write(folder, "a.mtlx", text() if callable(text) else text)]


IMAGE = ('<nodegraph name="g"><image name="i" type="color3"><input name="file" type="filename" value="%s"/></image>'
         '<output name="out" type="color3" nodename="i"/></nodegraph>\n')


def image(name, data):
    def build(folder):
        write(folder, name, data() if callable(data) else data)
        return [write(folder, "a.mtlx", ROOT % (IMAGE % name))]
    return build


def cut_images(make, extension):
    """One document of many images: one file, cut at every kilobyte."""
    def build(folder):
        whole = make(96, 96)
        body = ""
        for size in range(0, len(whole), 1024):
            write(folder, f"cut{size}.{extension}", whole[:size])
            body += (IMAGE % f"cut{size}.{extension}").replace('"g"', f'"g{size}"')
        return [write(folder, "a.mtlx", ROOT % body)]
    return build


def tiles(names):
    def build(folder):
        for name in names:
            (folder / name).touch()
        return [write(folder, "a.mtlx", ROOT % (IMAGE % "t_&lt;UVTILE>.png"))]
    return build


CASES = {
    "250,000 nodes": Case(document(lambda: nodes(250_000)), [], 700),
    "10^6 nodes": Case(document(lambda: nodes(1_000_000)), ["too-many-nodes"], 2500),
    "chain of 10^5 nodes": Case(document(lambda: chain(100_000, 1)), [], 700),
    "chain of 10^5, 10^4 outputs": Case(document(lambda: chain(100_000, 10_000)), [], 900),
    "chain in a circle": Case(document(lambda: chain(100_000, 0).replace(
        '<constant name="n0" type="float"/>',
        '<sin name="n0" type="float"><input name="in" type="float" nodename="n99999"/></sin>')), ["cycle"], 700),
    "250 graphs within graphs": Case(document(lambda: nested_graphs(250)), []),
    "2^40 nodes by graphs of graphs": Case(document(lambda: doubling_graphs(40)), ["too-many-nodes"], 3500),
    "include diamond, 2^30": Case(include_diamond(30), ["too-many-includes"]),
    "entity bomb": Case(entity_bomb(), ["doctype"]),
    "include ../../etc/passwd": Case(document('<xi:include href="../../../../../../etc/passwd"/>\n'), ["include-outside"]),
    "XML 10^6 deep": Case(raw("<a>" * 1_000_000), ["malformed-xml"], 512),
    "XML 10^6 deep, closed": Case(raw("<materialx version='1.39'>" + "<a>" * 10**6 + "</a>" * 10**6 + "</materialx>"),
                                  ["too-deep"], 512),
    "file over 64 MB": Case(raw(lambda: ROOT % (" " * (64 * MB))), ["file-too-large"]),
    "64 MB of '<'": Case(raw(lambda: "<" * (64 * MB)), ["too-many-elements"], 400),
    "64 MB of spaces": Case(raw(lambda: ROOT % (" " * (63 * MB))), [], 400),
    "30 MB of '&amp;'": Case(document(lambda: '<backdrop name="b" doc="%s"/>\n' % ("&amp;" * (6 * MB))), [], 400),
    "64 MB of '['": Case(document(lambda: (IMAGE % ("[" * (16 * MB)))), ["missing-image"], 600),
    "name of 10^5 letters": Case(document('<constant name="%s" type="float"/>\n' % ("a" * 100_000)), []),
    "10^5 attributes": Case(document('<backdrop name="b" %s/>\n' % " ".join(f'a{i}="0"' for i in range(100_000))), []),
    "10^5 inputs": Case(document(lambda: '<nodedef name="ND_a" node="a">%s<output name="out" type="float" value="0"/>'
                                 '</nodedef>\n<a name="x" type="float"/>\n' % "".join(
                                     f'<input name="i{i}" type="float" value="0"/>' for i in range(100_000))),
                        ["too-many-inputs"], 400),
    "2*10^5 nodedefs of one node": Case(document(lambda: "".join(
        f'<nodedef name="ND_a{i}" node="a" version="{i}"><output name="out" type="float" value="0"/></nodedef>\n'
        for i in range(200_000)) + '<a name="x" type="float" version="199999"/>\n'), ["no-implementation"], 600),
    "10^5 instances of unknown nodes": Case(document(lambda: "".join(
        f'<nothing name="n{i}" type="float"/>\n' for i in range(100_000))), ["unknown-node"], 400),
    "10^5 names twice": Case(document('<constant name="c" type="float"/>\n' * 100_000), ["duplicate-name"], 400),
    "10^5 looks in a row": Case(document(lambda: "".join(
        f'<look name="l{i}" inherit="l{i + 1}"/>\n' for i in range(100_000))), ["inherit-depth"], 400),
    "10^5 instances inherit": Case(document(lambda: "".join(
        f'<gltf_pbr name="n{i}" type="surfaceshader" inherit="n{i + 1}"/>\n' for i in range(100_000))),
                                   ["inherit-depth"], 400),
    "10^5 collections": Case(document(lambda: "".join(
        f'<collection name="c{i}" includecollection="c{i + 1}"/>\n' for i in range(100_000))),
                             ["unknown-collection"], 400),
    "10^5 implementations": Case(document(lambda: '<nodedef name="ND_a" node="a"><output name="out" type="float"/>'
                                          '</nodedef>\n' + "".join(
        f'<implementation name="I{i}" nodedef="ND_a" nodegraph="g"/>\n' for i in range(100_000)) +
        '<nodegraph name="g"><constant name="c" type="float"/><output name="out" type="float" nodename="c"/></nodegraph>\n'),
                                 [], 400),
    "EXR cut at every kilobyte": Case(cut_images(images.exr, "exr"), ["broken-image", "unreadable-image"]),
    "PNG cut at every kilobyte": Case(cut_images(images.png, "png"), ["broken-image", "unreadable-image"]),
    "HDR cut at every kilobyte": Case(cut_images(images.hdr, "hdr"), ["broken-image", "unreadable-image"]),
    "TIFF cut at every kilobyte": Case(cut_images(images.tiff, "tif"), ["broken-image", "unreadable-image"]),
    "BMP cut at every kilobyte": Case(cut_images(images.bmp, "bmp"), ["broken-image", "unreadable-image"]),
    "BMP of runs that claims 16384 by 16384": Case(image("a.bmp", images.bmp(3, 3, (16384, 16384), 8, 1)), ["broken-image"]),
    "GIF that claims 65535 by 65535": Case(image("a.gif", images.gif(65535, 65535)), ["image-too-large"]),
    "GIF that claims 16384 by 16384": Case(image("a.gif", images.gif(16384, 16384)), ["broken-image"]),
    "EXR that claims 2^31 by 2^31": Case(image("a.exr", images.exr(8, 8, (2**31, 2**31))), ["image-too-large"]),
    "EXR that claims 16384 by 16384": Case(image("a.exr", images.exr(8, 8, (16384, 16384))), ["broken-image"]),
    "EXR in a picture of 16384 by 16384": Case(image("a.exr", images.exr(8, 8, shown=(16384, 16384))), ["image-too-large"]),
    "PNG of 16000 by 16000 from 250 kB": Case(image("a.png", lambda: images.packed_png(16000, 16000)), ["image-too-large"]),
    "TIFF of 32768 by 32768": Case(image("a.tif", images.tiff(8, 8, (32768, 32768))), ["image-too-large"]),
    "image of no bytes": Case(image("a.png", b""), ["unreadable-image"]),
    "image ../../etc/passwd": Case(document(IMAGE % "../../../../../../../../etc/passwd"), ["image-outside"]),
    "image /dev/zero": Case(document(IMAGE % "/dev/zero"), ["image-outside"]),
    "10^4 tiles and one": Case(tiles([f"t_u{i % 101 + 1}_v{i // 101 + 1}.png" for i in range(10_001)]),
                               ["too-many-files"]),
    "two tiles far apart": Case(tiles(["t_u1_v1.png", "t_u900000_v900000.png"]), ["too-many-files"]),
}


def judge(case, outcome, share):
    if outcome.status not in (0, 1):
        return f"ended with {outcome.status}"
    if outcome.codes != case.codes:
        return f"said {sorted(outcome.codes)}, not {sorted(case.codes)}"
    most = case.megabytes if share == 1 else share * case.megabytes + 512
    if outcome.megabytes > most:
        return f"took more than {most:.0f} MB"
    return ""


def main():
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    chosen, share = sys.argv[2:], 1
    if chosen[:1] == ["--share"]:
        share, chosen = float(chosen[1]), chosen[2:]
    chosen = chosen or list(CASES)
    if chosen == ["--quick"]:
        chosen = [name for name in CASES if not CASES[name].slow]
    faults = 0
    print(f"{'case':34} {'wall s':>7} {'CPU s':>7} {'MB':>6}  said")
    for name in chosen:
        with tempfile.TemporaryDirectory() as temporary:
            arguments = CASES[name].build(pathlib.Path(temporary))
            outcome = run([sys.argv[1], "check", "--quiet", *arguments], TIMEOUT * share)
        fault = judge(CASES[name], outcome, share)
        faults += bool(fault)
        said = ", ".join(sorted(outcome.codes)) or "ok"
        print(f"{name:34} {outcome.seconds:7.2f} {outcome.busy:7.2f} {outcome.megabytes:6.0f}  {said}"
              f"{'  FAULT: ' + fault if fault else ''}", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
