#pragma once

#include <array>

#include "runtime/node/texture_source.h"
#include "runtime/program/recorder.h"
#include "runtime/value/vector.h"

namespace nacre {

/// What the kernel knows of an image while recording, and what is needed of it.
struct TexelFetch {
  Recorder& recorder;
  Int slot;  ///< Of the texture; may differ from lane to lane.
  texture_layout::TexelFormat format;
  int channels;               ///< That the image has, 1..4.
  int wanted;                 ///< Components that the result needs, 1..4.
  UniformChannels uniform{};  ///< As TextureSource::uniform.

  /// A word of the texture's array; outside it, the engines give word 0.
  Int word(Int index) const;

  /// The texel that starts at word `index`, in steps of its format: r32f, rgba16f and
  /// rgba32f are values, the integer formats are 0..255 and 0..65535 (exactly), so that
  /// filters multiply by scale() once, after their sums. Components that are not
  /// wanted, or that the image does not have, are literals: 0, and for alpha the step
  /// that means 1. So are those that are the same in all texels.
  Float4 texel(Int index) const;

  /// `steps` with those literals: what a function or a region gave back lost them.
  Float4 completed(Float4 steps) const;

  /// Whether a component differs from texel to texel.
  bool differs(int component) const;

  /// As values: steps times 1, 1/255 or 1/65535.
  Float4 scaled(Float4 steps) const;

 private:
  std::array<Float, 4> steps(Int index, int count) const;
};

}  // namespace nacre
