#pragma once

#include <optional>

#include "runtime/program/recorder.h"
#include "runtime/value/value.h"

namespace nacre {

/// A slot "max_anisotropy", i32, by which a host bounds the anisotropy of look-ups of images when
/// kernels are there, as for rays behind a bounce: 1 .. the one that they are recorded with, which
/// it is unless set. What lies outside counts as the nearest of these. To be called before all
/// bodies: what is recorded from then on reads it.
void offer_live_anisotropy(Recorder& recorder, int max_anisotropy);

/// That slot, in 1 .. `most`; nothing where it was not offered, or `most` is 1.
std::optional<Int> live_anisotropy(Recorder& recorder, int most);

}  // namespace nacre
