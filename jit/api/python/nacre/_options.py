"""How shaders are compiled."""

import enum
from collections.abc import Iterable, Mapping
from typing import Any, Literal, TypedDict

from . import _core


class SampleFlag(enum.IntFlag):
    """Bits of the channel `flags` of Entry.SAMPLE."""

    VALID = 1  # Else weight and densities are 0.
    DELTA = 2  # pdf is a probability; Entry.EVALUATE gives 0.
    TRANSMISSION = 4  # wi and wo are on different sides, by Ng.
    SUBSURFACE = 8  # Light goes on below the surface along wi: see Entry.SUBSURFACE.


class LobeKind(enum.IntFlag):
    """What a lobe is: the first four in the option `lobes`, all in channels lobes_wanted and kinds.

    In these channels glossy is what is rough; what is smooth is delta.
    """

    DIFFUSE_REFLECTION = 1
    GLOSSY_REFLECTION = 2
    DIFFUSE_TRANSMISSION = 4
    GLOSSY_TRANSMISSION = 8
    DELTA_REFLECTION = 16
    DELTA_TRANSMISSION = 32


class Transport(enum.IntEnum):
    """What paths carry: the channel transport."""

    RADIANCE = 0  # From the eye: refraction scales by the squares of the indices.
    IMPORTANCE = 1  # From lights: shading normals ask for a correction.


class CompileOptions(TypedDict, total=False):
    """Keywords of System.compile_material and compile_outputs; what is left out is usual."""

    # Machine code; or slow, the same bits; or slow, in double precision.
    engine: Literal["jit", "interpreter", "reference"]
    accuracy: Literal["standard", "precise", "fast"]
    lanes: int  # 1, 4, 8 or 16; 0: the widest that pays on this machine.
    # What may change without compiling: patterns of parameter paths ("SR_gold/base_color",
    # "SR_gold/coat*", "*"). All others are folded in.
    live: Iterable[str]
    # Which of those, and of frame, time, object_to_world and world_to_object, come with each
    # point, as channels of the parameter's name. By their names and no pattern: "exterior_index",
    # the index of refraction outside, which dielectrics' is divided by (without it vacuum's, 1), and
    # "texture_u", a number in [0, 1) by which images give one of the texels that they filter.
    varying: Iterable[str]
    lobes: LobeKind  # Those that are modelled.
    reverse_pdf: bool  # SAMPLE and EVALUATE also store pdf_reverse.
    lobe_mask: bool  # A parameter lobe_mask switches lobes off later.
    by_lobe: bool  # Also the part of each lobe: "f.lobe0", "weight.lobe0", ...
    # SAMPLE, EVALUATE and SHADE read a channel lobes_wanted, LobeKind bits of what shall scatter at
    # that point, and store kinds.
    lobes_wanted: bool
    transport: bool  # They read a channel transport, and scale f and weight for it.
    min_alpha: bool  # A parameter min_alpha raises the roughness of what is smoother.
    energy_conserving: bool  # Lobes together give no more light than arrives, whatever the model.
    # Entries that are compiled; BEGIN comes with what reads its state. None: all but EVALUATE_AT,
    # SHADE, INTERIOR, SUBSURFACE, SHADOW and EMIT.
    entries: Iterable[_core.Entry]
    # What BEGIN and SHADE also store: "albedo", "emission", "opacity", "normal", "roughness", or
    # a value of the graph by its path: "NG_marble/noise1", "SR_marble/base_color".
    with_begin: Iterable[str]
    side: Literal["front", "back"]
    background: bool  # Return at once, and interpret until the code is there; the same bits.
    max_seconds: float  # Of the call; 60 unless set.
    max_anisotropy: int  # Of footprints on images, at most 64; 32 unless set.
    no_footprints: bool  # Points have no extent, and no channels as dPdx are read.
    # Parameters change footprints later: footprint_scale multiplies them, max_anisotropy, an int, is
    # at most the one above.
    live_footprints: bool
    # noise2d, noise3d and fractals fade where the footprint of a point covers their cells; octaves
    # of which nothing is left are not computed.
    fade_noise: bool
    # What depends on live parameters and one number, as Fresnel's factors of a metal do, is read from
    # polynomials: fitted when a call meets new values, in some ten microseconds, and at most 4e-5
    # off ("fast": 4e-3), or computed.
    fit_parameters: bool
    # Of facets, for what several scatterings between them bring back: "all", of "reflection" alone
    # (rough glass is darker), or "nothing" (rough metals too). What is left out costs nothing.
    compensation: Literal["all", "reflection", "nothing"]
    # The text of a file that `nacre tune` wrote: says accuracy, compensation, max_anisotropy,
    # fade_noise and no_footprints of the materials and outputs that it names.
    profile: str
    # In place of all these: the cheapest kernels whose numbers, but for one of a thousand, are off
    # by no more, and each by no more than three times that; found by measuring, which takes
    # seconds. See Shader.error and Shader.profile.
    max_error: float
    error_floor: float  # Errors are shares of a number, or of so much of its channel's largest; 0.01.
    error_is_absolute: bool  # They are differences.
    error_points: int  # At how many points, 1,000 to 1,000,000; 2048 unless set.
    # The text that `nacre render --record-points` wrote: of materials, measure where a scene shades
    # them.
    error_record: str
    measure_error: bool  # Shader.error is wanted of what is compiled as it is asked for.
    # What is known of numbers that kernels read: least and greatest of a channel, "uv0.x", a group,
    # "uv0", what is live, "SR_gold/coat", or a scalar product, "dot(N,wo)". Kernels leave out what
    # cannot happen, with the same bits, and find out where it is not so. See Shader.facts.
    facts: Mapping[str, tuple[float, float]]
    search_paths: Iterable[str]  # Of images, after the document's own folder.
    files_anywhere: bool  # Images also from outside those folders.
    missing_images_pass: bool  # An image that cannot be had is a warning and no error.
    lenient: bool  # Take what other programs' exporters get wrong.
    working_space: str  # Of colours; the document's, or lin_rec709, unless set.
    output_space: str  # That colours of outputs are given in; the working space unless set.
    distance_unit: str  # What one unit of scene length is; "meter" unless set.
    geometry: str  # Full path of what is shaded, for its tokens in file names.
    frame: int  # Of "{frame}" in file names.
    max_nodes: int  # Of a graph; 250,000 unless set.
    max_instructions: int  # Of a kernel; 500,000 unless set.


# As <nacre/nacre.h> has them.
_NAMED = {
    "engine": ("jit", "interpreter", "reference"),
    "accuracy": ("standard", "precise", "fast"),
    "side": ("front", "back"),
    "compensation": ("all", "reflection", "nothing"),
}
_LISTS = ("live", "varying", "with_begin", "search_paths")


def entry_bits(entries: Iterable[_core.Entry]) -> int:
    bits = 0
    for entry in entries:
        bits |= 1 << int(entry)
    return bits


def _value(name: str, value: Any) -> Any:
    if name in _NAMED:
        if value not in _NAMED[name]:
            raise ValueError(f"{name} is {value!r}, not one of {', '.join(_NAMED[name])}")
        return _NAMED[name].index(value)
    if name in _LISTS:
        if isinstance(value, str):  # One letter each is never what was meant.
            raise TypeError(f"{name} takes a list of texts, not the text {value!r}")
        return [str(each) for each in value]
    if name == "facts":
        return [(str(fact), float(least), float(most)) for fact, (least, most) in value.items()]
    if name == "entries":
        return entry_bits(value)
    return int(value) if name == "lobes" else value


def core_options(options: Mapping[str, Any]) -> _core.CompileOptions:
    made = _core.CompileOptions()
    for name, value in options.items():
        if name not in CompileOptions.__annotations__:
            raise TypeError(f"there is no compile option {name!r}; there are "
                            f"{', '.join(CompileOptions.__annotations__)}")
        setattr(made, name, _value(name, value))
    return made
