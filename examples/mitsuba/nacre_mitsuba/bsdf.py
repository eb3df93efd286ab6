"""nacre_bsdf: a material."""

import warnings

import drjit as dr
import mitsuba as mi
from nacre import Entry, LobeKind, SampleFlag, Transport

from .kernels import Plugin, check_inputs

Flags = mi.BSDFFlags

# A component of the plug-in for each kind of lobe, by the bits that LobeKind has.
_KINDS = {
    LobeKind.DIFFUSE_REFLECTION: Flags.DiffuseReflection,
    LobeKind.GLOSSY_REFLECTION: Flags.GlossyReflection,
    LobeKind.DIFFUSE_TRANSMISSION: Flags.DiffuseTransmission,
    LobeKind.GLOSSY_TRANSMISSION: Flags.GlossyTransmission,
    LobeKind.DELTA_REFLECTION: Flags.DeltaReflection,
    LobeKind.DELTA_TRANSMISSION: Flags.DeltaTransmission,
}
_TRANSMITS = LobeKind.DIFFUSE_TRANSMISSION | LobeKind.GLOSSY_TRANSMISSION
_ENTRIES = [Entry.BEGIN, Entry.SAMPLE, Entry.EVALUATE, Entry.ALBEDO, Entry.OPACITY, Entry.EMISSION]


class NacreBSDF(mi.BSDF):
    def __init__(self, props: mi.Properties) -> None:
        mi.BSDF.__init__(self, props)
        options = {"entries": (*_ENTRIES, Entry.INTERIOR), "lobes_wanted": True, "transport": True}
        self.nacre = Plugin(props, "material", options, is_material=True)
        shader = self.shader = self.nacre.shader
        check_inputs(self.nacre, [*_ENTRIES, Entry.INTERIOR])
        self.say_what_is_lost()
        kinds = LobeKind(0)
        for lobe in shader.lobes:
            kinds |= lobe.kinds
        # What is glossy may be smooth, at one point and not at another.
        if kinds & LobeKind.GLOSSY_REFLECTION:
            kinds |= LobeKind.DELTA_REFLECTION
        if kinds & LobeKind.GLOSSY_TRANSMISSION:
            kinds |= LobeKind.DELTA_TRANSMISSION
        self.kinds = [kind for kind in _KINDS if kind & kinds]
        self.transmits = bool(kinds & _TRANSMITS) and shader.has(Entry.INTERIOR)
        sides = Flags.FrontSide | Flags.BackSide | Flags.SpatiallyVarying
        components = [_KINDS[kind] | sides for kind in self.kinds]
        self.cut_out = shader.has(Entry.OPACITY)
        if self.cut_out:
            components.append(Flags.Null | sides)
        self.m_components = components
        self.m_flags = 0
        for each in components:
            self.m_flags |= each

    def say_what_is_lost(self) -> None:
        media = {each.name.partition(".")[0] for each in self.shader.results(Entry.INTERIOR)}
        lost = {"light that it emits": self.shader.has(Entry.EMISSION),
                "another shader on its back": self.shader.has_back,
                "the medium inside": not media.isdisjoint({"absorption", "scattering"})}
        for what in (name for name, is_there in lost.items() if is_there):
            warnings.warn(f"{self.nacre.file}: nacre_bsdf leaves out {what}", stacklevel=2)

    def wanted(self, ctx) -> int:
        """LobeKind bits of what a context asks for."""
        return sum(int(kind) for index, kind in enumerate(self.kinds)
                   if ctx.is_enabled(_KINDS[kind], index))

    def given(self, ctx, si, **more) -> dict[str, object]:
        transport = Transport.RADIANCE
        if ctx.mode == mi.TransportMode.Importance:
            transport = Transport.IMPORTANCE
            more["Ng"] = si.sh_frame.n  # Mitsuba's integrators correct for shading normals themselves.
        return {"transport": mi.Int32(transport), "lobes_wanted": mi.Int32(self.wanted(ctx)),
                **{f"{name}.{axis}": part for name, parts in more.items()
                   for axis, part in zip("xyz", parts)}}

    def run(self, entry, si, active, given=None):
        """Results; none where the material has nothing of the kind."""
        if not self.shader.has(entry):
            return None
        begin = [Entry.BEGIN] if self.shader.has(Entry.BEGIN) else []
        entries = [entry] if entry in (Entry.ALBEDO, Entry.OPACITY, Entry.INTERIOR) else [*begin, entry]
        return self.nacre.run(entries, si, active, given)

    def straight(self, si, active) -> mi.Color3f:
        """What of light goes on as if there was nothing."""
        if not self.cut_out:
            return mi.Color3f(0)
        found = self.run(Entry.OPACITY, si, active)
        opacity = found["opacity"]
        return 1 - opacity + opacity * _color(found, "transmission")

    def chance(self, ctx, straight) -> mi.Float:
        """That a sample goes straight on."""
        asked = self.cut_out and ctx.is_enabled(Flags.Null, len(self.m_components) - 1)
        return dr.mean(straight) if asked else mi.Float(0)

    # What Mitsuba asks. Its wi is Nacre's wo.

    def sample(self, ctx, si, sample1, sample2, active=True):
        active = mi.Bool(active)
        straight = self.straight(si, active)
        chance = self.chance(ctx, straight)
        passes = active & (sample1 < chance)
        last = dr.one_minus_epsilon(mi.Float)
        lobe = dr.minimum((sample1 - chance) / dr.maximum(1 - chance, 1e-6), last)
        given = self.given(ctx, si, u=(sample2.x, sample2.y, lobe))
        found = self.run(Entry.SAMPLE, si, active & ~passes, given)

        bs, weight = dr.zeros(mi.BSDFSample3f, dr.width(si)), mi.Color3f(0)
        if found is not None:
            flags = found["flags"]
            valid = active & ~passes & _has(flags, SampleFlag.VALID)
            bs.wo = dr.select(valid, si.to_local(_vector(found, "wi")), 0)
            bs.pdf = dr.select(valid, found["pdf"] * (1 - chance), 0)
            bs.eta = dr.select(_has(flags, SampleFlag.TRANSMISSION),
                               self.eta(si, valid, mi.Frame3f.cos_theta(bs.wo)), 1)
            for index, kind in enumerate(self.kinds):
                is_kind = valid & (found["kinds"] == int(kind))
                bs.sampled_type[is_kind] = int(_KINDS[kind])
                bs.sampled_component[is_kind] = index
            kept = (1 - straight) / dr.maximum(1 - chance, 1e-6)
            weight = dr.select(valid, _color(found, "weight") * kept, 0)
        if self.cut_out:
            bs.wo[passes], bs.pdf[passes], bs.eta[passes] = -si.wi, chance, 1
            bs.sampled_type[passes] = int(Flags.Null)
            bs.sampled_component[passes] = len(self.m_components) - 1
            weight[passes] = straight / chance
        return bs, weight

    def eval_pdf(self, ctx, si, wo, active=True):
        active = mi.Bool(active)
        found = self.run(Entry.EVALUATE, si, active, self.given(ctx, si, wi=si.to_world(wo)))
        if found is None:
            return mi.Color3f(0), mi.Float(0)
        straight = self.straight(si, active)
        pdf = found["pdf"] * (1 - self.chance(ctx, straight))
        return (dr.select(active, _color(found, "f") * (1 - straight), 0),
                dr.select(active, pdf, 0))

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf_sample(self, ctx, si, wo, sample1, sample2, active=True):
        return *self.eval_pdf(ctx, si, wo, active), *self.sample(ctx, si, sample1, sample2, active)

    def eval_null_transmission(self, si, active=True):
        return self.straight(si, mi.Bool(active))

    def eval_diffuse_reflectance(self, si, active=True):
        """The share of light that scatters: all of the albedo."""
        found = self.run(Entry.ALBEDO, si, mi.Bool(active))
        return mi.Color3f(0) if found is None else _color(found, "albedo")

    def eta(self, si, active, cosine) -> mi.Float:
        """Index on the side that light comes from over that of the viewer's."""
        if not self.transmits:
            return mi.Float(1)
        inside = self.run(Entry.INTERIOR, si, active)["eta"]
        return dr.select(cosine < 0, inside, 1 / dr.maximum(inside, 1e-6))

    def traverse(self, callback):
        self.nacre.traverse(callback)

    def parameters_changed(self, keys):
        self.nacre.parameters_changed(keys)

    def to_string(self):
        return f"NacreBSDF[{self.nacre.file}, {self.nacre.name}, {dict(self.nacre.parameters)}]"


def _has(flags, bit: SampleFlag) -> mi.Bool:
    return (flags & int(bit)) != 0


def _vector(found, name) -> mi.Vector3f:
    return mi.Vector3f(*(found[f"{name}.{axis}"] for axis in "xyz"))


def _color(found, name) -> mi.Color3f:
    """0 where a kernel has no such result."""
    return mi.Color3f(*(found.get(f"{name}.{axis}", 0) for axis in "xyz"))
