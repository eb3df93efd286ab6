"""Documents that crashed the program, never ended or took all memory, and variants of them.

Each builder writes files into a folder and returns the document. CLASSES: name -> builders, the
first of which is the smallest that shows the fault.
"""

ROOT = '<materialx version="1.39">\n%s</materialx>\n'
NODE = ('<nodedef name="ND_t" node="t">%s<output name="out" type="float"/></nodedef>\n'
        '<implementation name="IM_t" nodedef="ND_t" %s/>\n'
        '<texcoord name="uv" type="vector2"/>\n'
        '<extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>\n'
        '<t name="n" type="float">%s</t>\n<output name="o" type="float" nodename="n"/>\n')
INPUT = '<input name="in" type="float" value="0.5"/>'
USE = '<input name="in" type="float" nodename="u"/>'


def document(body):
    def build(folder):
        path = folder / "a.mtlx"
        path.write_text(ROOT % (body() if callable(body) else body))
        return path
    return build


def expression(text, inputs=True):
    def body():
        code = (text() if callable(text) else text).replace("&", "&amp;").replace("<", "&lt;")
        how = f'target="nacre" sourcecode="{code}"'
        return NODE % (INPUT if inputs else "", how, USE if inputs else "")
    return document(body)


def functions(text):
    def build(folder):
        (folder / "a.glsl").write_text(text() if callable(text) else text)
        return document(NODE % (INPUT, 'target="genglsl" file="a.glsl" function="f"', USE))(folder)
    return build


def stolen(name, ports, type_, extra=""):
    inputs = "".join(f'<input name="{port}" type="{kind}"/>' for port, kind in ports)
    return document(f'<nodedef name="{name}" node="q">{inputs}<output name="out" type="{type_}"/></nodedef>{extra}\n'
                    f'<q name="n" type="{type_}"/><output name="o" type="{type_}" nodename="n"/>\n')


def nest(loops, body="s = fract(s * 1.1 + float(i0));"):
    heads = "".join(f"for (int i{k} = 0; i{k} < 1024; i{k}++) " for k in range(loops))
    return functions(f"void f(float a, out float b) {{ float s = a; {heads}{{ {body} }} b = s; }}\n")


def calls(levels, leaf="return x;", each=2):
    lines = [f"float g0(float x) {{ {leaf} }}\n"]
    for i in range(1, levels):
        sums = " + ".join(f"g{i - 1}(x * 1.{k})" for k in range(each))
        lines.append(f"float g{i}(float x) {{ return {sums}; }}\n")
    return functions("".join(lines) + f"void f(float a, out float b) {{ b = g{levels - 1}(a); }}\n")


def macros(levels, use, first="", each=10):
    lines = [f"#define Z {first}\n", "#define Z0 " + "Z " * each + "\n"]
    lines += [f"#define Z{i} " + f"Z{i - 1} " * each + "\n" for i in range(1, levels)]
    return functions("".join(lines) + use % f"Z{levels - 1}" + "\nvoid f(float a, out float b) { b = a; }\n")


def definitions(levels, each):
    """Nodedef k is a graph of `each` nodes k-1 in a row."""
    def body():
        lines = []
        for i in range(levels):
            category = "sin" if i == 0 else f"d{i - 1}"
            nodes = "".join(
                f'<{category} name="m{j}" type="float"><input name="in" type="float" '
                + ('interfacename="in"' if j == 0 else f'nodename="m{j - 1}"') + f'/></{category}>'
                for j in range(each))
            lines.append(f'<nodedef name="ND_d{i}" node="d{i}"><input name="in" type="float" value="0"/>'
                         f'<output name="out" type="float"/></nodedef><nodegraph name="NG_d{i}" nodedef="ND_d{i}">'
                         f'{nodes}<output name="out" type="float" nodename="m{each - 1}"/></nodegraph>\n')
        return "".join(lines) + f'<d{levels - 1} name="n" type="float"/><output name="o" type="float" nodename="n"/>\n'
    return document(body)


LAYERS = {
    "mix": '<mix name="b%d" type="BSDF"><input name="bg" type="BSDF" nodename="b%d"/>'
           '<input name="fg" type="BSDF" nodename="b%d"/><input name="mix" type="float" value="0.3"/></mix>',
    "add": '<add name="b%d" type="BSDF"><input name="in1" type="BSDF" nodename="b%d"/>'
           '<input name="in2" type="BSDF" nodename="b%d"/></add>',
    "layer": '<layer name="b%d" type="BSDF"><input name="top" type="BSDF" nodename="b%d"/>'
             '<input name="base" type="BSDF" nodename="b%d"/></layer>',
}


def diamond(levels, kinds, leaf="oren_nayar_diffuse_bsdf"):
    """A closure that is used twice at each level."""
    def body():
        lines = [f'<{leaf} name="b0" type="BSDF"/>\n']
        lines += [LAYERS[kinds[i % len(kinds)]] % (i, i - 1, i - 1) + "\n" for i in range(1, levels)]
        return "".join(lines) + (f'<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" '
                                 f'nodename="b{levels - 1}"/></surface><surfacematerial name="M" type="material">'
                                 '<input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>\n')
    return document(body)


def surfaces(levels):
    """A surface that is mixed with itself at each level."""
    mix = ('<mix name="s%d" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="s%d"/>'
           '<input name="bg" type="surfaceshader" nodename="s%d"/><input name="mix" type="float" value="0.5"/></mix>\n')
    return document('<standard_surface name="s0" type="surfaceshader"/>\n' +
                    "".join(mix % (i, i - 1, i - 1) for i in range(1, levels)) +
                    '<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" '
                    f'nodename="s{levels - 1}"/></surfacematerial>\n')


ADD = [("in1", "float"), ("in2", "float")]
CLASSES = {
    "name of a library nodedef": [
        stolen("ND_add_float", [], "float"),
        stolen("ND_add_float", ADD, "matrix44"),
        stolen("ND_image_color3", [("file", "float")], "color3"),
        stolen("ND_standard_surface_surfaceshader", [], "color3"),
        stolen("ND_mix_bsdf", [("fg", "BSDF")], "BSDF"),
        stolen("ND_noise2d_float", [("texcoord", "color4")], "float"),
        stolen("ND_add_float", [], "float",
               '<implementation name="I" nodedef="ND_add_float" target="nacre" sourcecode="{{in1}} + 1.0"/>'),
        stolen("ND_surfacematerial", [], "float"),
    ],
    "unknown names in expressions": [
        expression("nope + 1.0", inputs=False),
        expression("{{in}} + {{other}}"),
        expression("{{in}} + 1.0", inputs=False),
        expression("nope(1.0)", inputs=False),
        expression("nope.x", inputs=False),
        expression("sin(cos(nope[0]))", inputs=False),
        expression("-(nope)", inputs=False),
    ],
    "deep expressions": [
        expression(lambda: "{{in}}" + "+{{in}}" * 13_999),
        expression(lambda: "{{in}}" + ",{{in}}" * 14_000),
        expression(lambda: "vec2({{in}}).xx" + ".xy" * 14_000 + ".x"),
        expression(lambda: "mat4({{in}})" + "[0]" * 14_000),
        expression(lambda: "(" * 14_000 + "{{in}}" + ")" * 14_000),
        expression(lambda: "-" * 14_001 + "{{in}}"),
        expression(lambda: "{{in}} > 0.5 ? 1.0 : " * 7_000 + "{{in}}"),
        functions(lambda: "void f(float a, out float b) " + "{" * 20_000 + "b = a;" + "}" * 20_000 + "\n"),
        functions(lambda: "void f(float a, out float b) { b = a; " + "if (b > 0.0) " * 20_000 + "b = 1.0; }\n"),
        functions(lambda: "float g0(float x) { return x; }\n" + "".join(
            f"float g{i}(float x) {{ return g{i - 1}(x); }}\n" for i in range(1, 5000)) +
            "void f(float a, out float b) { b = g4999(a); }\n"),
    ],
    "kernels that never end": [
        nest(3),
        nest(4),
        nest(8),
        nest(2, "for (int k = 0; k < 1024; k++) for (int l = 0; l < 1024; l++) s = sin(s) + cos(float(l));"),
        functions("void f(float a, out float b) { float s = a; while (s < 2.0) { float t = s; do { t = fract(t * 1.1);"
                  " for (int i = 0; i < 1000; i++) t = sin(t); } while (t < 3.0); } b = s; }\n"),
        functions("float g(float x) { for (int i = 0; i < 1024; i++) x = fract(x * 1.1); return x; }\n"
                  "float h(float x) { for (int i = 0; i < 1024; i++) x = g(x); return x; }\n"
                  "void f(float a, out float b) { b = a; for (int i = 0; i < 1024; i++) b = h(b); }\n"),
    ],
    "trees of calls": [
        calls(60),
        calls(40),
        calls(30, each=4),
        calls(25, leaf="for (int i = 0; i < 1000; i++) x = sin(x); return x;"),
        calls(60, leaf="return x > 0.5 ? x : 1.0;"),
        calls(20, each=9),
    ],
    "macros": [
        macros(12, "%s"),
        macros(12, "#if %s 1\n#endif"),
        macros(12, "#if 1 %s\n#endif", "+ 1"),
        macros(7, "#define Q(x) x x\nfloat q = 0.0 %s;", "+ 1.0"),
        macros(60, "%s", each=2),
        macros(12, "#ifdef Z\n%s\n#endif"),
        functions("#define A B B\n#define B A A\nA\nvoid f(float a, out float b) { b = a; }\n"),
    ],
    "definitions in definitions": [
        definitions(5000, 1),
        definitions(1000, 1),
        definitions(30, 10),
        definitions(60, 2),
        definitions(6, 20),
        definitions(300, 3),
    ],
    "closures used twice": [
        diamond(40, ["mix"]),
        diamond(40, ["add"]),
        diamond(40, ["layer"], "dielectric_bsdf"),
        diamond(60, ["mix", "add", "layer"], "sheen_bsdf"),
        diamond(2000, ["mix"]),
        surfaces(40),
    ],
}
