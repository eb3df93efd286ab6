"""nacre_texture: a graph output."""

import drjit as dr
import mitsuba as mi
from nacre import Entry

from .kernels import Plugin, check_inputs


class NacreTexture(mi.Texture):
    def __init__(self, props: mi.Properties) -> None:
        mi.Texture.__init__(self, props)
        self.nacre = Plugin(props, "output", {}, is_material=False)
        check_inputs(self.nacre, [Entry.OUTPUTS])
        self.results = [each.name for each in self.nacre.shader.results(Entry.OUTPUTS)]

    def channels(self, si, active) -> list[mi.Float]:
        found = self.nacre.run([Entry.OUTPUTS], si, mi.Bool(active))
        return [mi.Float(found[name]) for name in self.results]

    def eval_3(self, si, active=True):
        """What has a fourth number, as alpha, loses it; what has no third has 0 there."""
        found = self.channels(si, active)
        if len(found) == 1:
            return mi.Color3f(found[0])
        return mi.Color3f(*(found + [mi.Float(0)])[:3])

    def eval_1(self, si, active=True):
        """The luminance of a colour."""
        found = self.channels(si, active)
        return found[0] if len(found) == 1 else mi.luminance(mi.Color3f(*(found + [mi.Float(0)])[:3]))

    def eval(self, si, active=True):
        return self.eval_3(si, active)

    def mean(self):
        """Over texture coordinates from 0 to 1, at the origin."""
        si = dr.zeros(mi.SurfaceInteraction3f, 64 * 64)
        row, column = dr.arange(mi.UInt32, 64 * 64) // 64, dr.arange(mi.UInt32, 64 * 64) % 64
        si.uv = (mi.Point2f(column, row) + 0.5) / 64
        si.n = si.sh_frame.n = mi.Normal3f(0, 0, 1)
        si.sh_frame.s, si.sh_frame.t = mi.Vector3f(1, 0, 0), mi.Vector3f(0, 1, 0)
        si.wi, si.dp_dv = mi.Vector3f(0, 0, 1), mi.Vector3f(0, -1, 0)
        return dr.mean(self.eval_1(si))

    def is_spatially_varying(self):
        return True

    def traverse(self, callback):
        self.nacre.traverse(callback)

    def parameters_changed(self, keys):
        self.nacre.parameters_changed(keys)

    def to_string(self):
        return f"NacreTexture[{self.nacre.file}, {self.nacre.name}, {dict(self.nacre.parameters)}]"
