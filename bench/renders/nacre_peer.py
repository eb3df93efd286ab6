"""The scene for `nacre render`: `run` makes a picture of it."""

import resource
import subprocess

import gltf_scene
import numpy
from scene import COLOR, DEPTH, FLOOR, GOLD, POSITION, TARGET, YFOV, geometry, sky

PACKAGES = ("OpenEXR==3.5.3",)


def text(value):
    return ", ".join(map(str, value))


def glass(alpha):
    return f"""<dielectric_bsdf name="b" type="BSDF"><input name="ior" type="float" value="1.5"/>
      <input name="roughness" type="vector2" value="{alpha}, {alpha}"/>
      <input name="scatter_mode" type="string" value="RT"/></dielectric_bsdf>"""


BALLS = {
    "gold, roughness .3": f"""<conductor_bsdf name="b" type="BSDF">
      <input name="ior" type="color3" value="{text(GOLD["eta"])}"/>
      <input name="extinction" type="color3" value="{text(GOLD["k"])}"/>
      <input name="roughness" type="vector2" value="0.3, 0.3"/></conductor_bsdf>""",
    "plastic, roughness .3": f"""<dielectric_bsdf name="gloss" type="BSDF">
      <input name="roughness" type="vector2" value="0.3, 0.3"/></dielectric_bsdf>
      <oren_nayar_diffuse_bsdf name="base" type="BSDF">
      <input name="color" type="color3" value="{text(COLOR)}"/></oren_nayar_diffuse_bsdf>
      <layer name="b" type="BSDF"><input name="top" type="BSDF" nodename="gloss"/>
      <input name="base" type="BSDF" nodename="base"/></layer>""",
    "glass, smooth": glass(0),
    "glass, roughness .2": glass(0.2),
}


def material(name, bsdf, xml):
    return f"""{xml}<surface name="{name}_s" type="surfaceshader">
      <input name="bsdf" type="BSDF" nodename="{bsdf}"/></surface>
      <surfacematerial name="{name}" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="{name}_s"/></surfacematerial>"""


def write_scene(folder):
    scene = gltf_scene.Scene("bench/renders/equal_error.py", ("ball", "floor"))
    for index, (name, rows) in enumerate(geometry().items()):
        scene.node(name=name, mesh=scene.mesh(*rows, index))
    scene.look_at(POSITION, TARGET, YFOV)
    scene.write(folder / "scene.gltf")


class Peer:
    """Metal is that of one scattering between facets: the others have no more."""

    def __init__(self, subject, folder, asked):
        import OpenEXR

        self.exr, self.folder, self.asked = OpenEXR, folder, asked
        write_scene(folder)
        self.exr.File({}, {"RGB": sky()}).write(str(folder / "sky.exr"))
        floor = f"""<oren_nayar_diffuse_bsdf name="f" type="BSDF">
          <input name="color" type="color3" value="{text([FLOOR] * 3)}"/></oren_nayar_diffuse_bsdf>"""
        (folder / "scene.mtlx").write_text(
            f"""<materialx version="1.39">{material("ball", "b", BALLS[subject])}
            {material("floor", "f", floor)}</materialx>""", encoding="utf-8")
        self.run(1000, 1)  # Kernels are cached from now on.

    def run(self, seed, spp):
        """A picture, and the CPU time of the program in seconds."""
        out = self.folder / "nacre.exr"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([self.asked.nacre, "render", "scene.mtlx", "--scene", "scene.gltf", "--environment",
                        "sky.exr", "--spp", str(spp), "--size", str(self.asked.size), "--max-depth", str(DEPTH),
                        "--compensation", "nothing", "--seed", str(seed), "--out", out.name,
                        *self.asked.option],
                       cwd=self.folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        with self.exr.File(str(out)) as file:
            picture = numpy.float64(file.channels()["RGB"].pixels)
        return picture, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
