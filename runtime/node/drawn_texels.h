#pragma once

#include <optional>
#include <string_view>

#include "runtime/program/recorder.h"
#include "runtime/value/value.h"

namespace nacre {

/// The channel of a number in [0, 1) by which every look-up of an image at a point draws one of the
/// texels that its filter weighs: over all numbers the mean is the filtered value. One number for
/// all look-ups, so that images of one size give what belongs together. (Pharr, Wronski, Salvi,
/// Fajardo, "Filtering After Shading With Stochastic Texture Filtering", I3D 2024.)
inline constexpr std::string_view drawn_texels_channel = "texture_u";

/// Makes look-ups that are recorded from now on read that channel.
void offer_drawn_texels(Recorder& recorder);

/// The channel, below 1; nothing where it was not offered.
std::optional<Float> drawn_texels(Recorder& recorder);

}  // namespace nacre
