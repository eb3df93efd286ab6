"""MaterialX in Mitsuba 3: a BSDF and a texture whose kernels are Nacre's.

    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")
    import nacre_mitsuba

    scene = mi.load_dict({..., "bsdf": {"type": "nacre_bsdf", "filename": "brass.mtlx"}})
    with nacre_mitsuba.eager():
        picture = mi.render(scene)

nacre_bsdf
    filename      a MaterialX document
    material      one of its materials; without it the first
    live          names or patterns of inputs that stay open, with commas between: mi.traverse
                  has them, to be changed without compiling
    PATH          a value of the input of that path, "SR_brass/base_color", which is open then. A
                  texture gives it point by point
    accuracy      "standard", "precise" or "fast"

nacre_texture
    filename, live, PATH, accuracy    as above
    output        a graph output, "NG_marble/base_color"; without it the only one

Both read what Mitsuba knows of a hit: position, frame, texture coordinates. v goes up in MaterialX
and down in Mitsuba, whose loaders turn it: both show a picture as `bitmap` does. Object space is
world space, and points have no footprint: images are read at their finest level.

Kernels run on Dr.Jit's arrays where these lie, as soon as they are called. So Mitsuba must have
numbers by then, and not record what it will do: that is what `eager` is for. Its paths go bounce by
bounce then, and for each material are one array without gaps. Nothing is differentiated. Mitsuba
finds LLVM by itself, or by DRJIT_LIBLLVM_PATH=/usr/lib/llvm-19/lib/libLLVM.so.
"""

import contextlib

import drjit
import mitsuba

if not (mitsuba.variant() or "").startswith("llvm_") or not mitsuba.variant().endswith("_rgb"):
    raise ImportError("nacre_mitsuba computes on arrays of the CPU, in three channels: first "
                      f"mitsuba.set_variant('llvm_ad_rgb'); it is {mitsuba.variant()!r}")

from .bsdf import NacreBSDF
from .texture import NacreTexture

__all__ = ["NacreBSDF", "NacreTexture", "eager"]

mitsuba.register_bsdf("nacre_bsdf", NacreBSDF)
mitsuba.register_texture("nacre_texture", NacreTexture)


@contextlib.contextmanager
def eager():
    """Within it Mitsuba computes loops, calls and branches one by one, on arrays."""
    flags = [drjit.JitFlag.SymbolicLoops, drjit.JitFlag.SymbolicCalls,
             drjit.JitFlag.SymbolicConditionals]
    before = [drjit.flag(flag) for flag in flags]
    try:
        for flag in flags:
            drjit.set_flag(flag, False)
        yield
    finally:
        for flag, value in zip(flags, before):
            drjit.set_flag(flag, value)
