#include "nodes/texture2d/texel_fetch.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace nacre {

namespace {

using texture_layout::TexelFormat;

/// Bits [first, first + width) of a word, as a number.
Float field(Int word, int first, int width) {
  const Int shifted = shift_right_logical(word, Int(first));
  // The highest field is alone after the shift.
  return to_float(first + width == 32 ? shifted : shifted & Int((1 << width) - 1));
}

}  // namespace

Int TexelFetch::word(Int index) const {
  const std::array<Ref, 2> operands{slot.ref(), index.ref()};
  return Int(recorder.emit(Op::texel, operands));
}

std::array<Float, 4> TexelFetch::steps(Int index, int count) const {
  std::array<Float, 4> steps;
  for (int c = 0; c < count; ++c) {
    Float& step = steps[static_cast<std::size_t>(c)];
    switch (format) {
      case TexelFormat::r32f:
      case TexelFormat::rgba32f: step = float_of_bits(word(index + Int(c))); break;
      case TexelFormat::rgba8: step = field(word(index), 8 * c, 8); break;
      case TexelFormat::rgba16: step = field(word(index + Int(c / 2)), 16 * (c % 2), 16); break;
      case TexelFormat::rgba16f:
        step = half_to_float(shift_right_logical(word(index + Int(c / 2)), Int(16 * (c % 2))));
        break;
    }
  }
  return steps;
}

Float4 TexelFetch::texel(Int index) const {
  const std::array<Float, 4> all = steps(index, std::min(channels, wanted));
  return completed({all[0], all[1], all[2], all[3]});
}

bool TexelFetch::differs(int component) const {
  const bool is_read = component < std::min(channels, wanted);
  return is_read && !uniform[static_cast<std::size_t>(component)];
}

Float4 TexelFetch::completed(Float4 steps) const {
  int c = 0;
  visit(steps, [&](Float& step) {
    const bool is_alpha = c == 3;
    const std::optional<float> known = uniform[static_cast<std::size_t>(c)];
    if (c >= channels) {
      step = Float(is_alpha ? texture_layout::step_of_one(format) : 0.0f);
    } else if (known) {
      step = Float(*known);
    }
    if (c++ >= wanted) step = Float(0.0f);
  });
  return steps;
}

Float4 TexelFetch::scaled(Float4 steps) const {
  const float one = texture_layout::step_of_one(format);
  if (one == 1.0f) return steps;
  // Rounded once more where the step is no power of two; 255 of 255 is exactly 1.
  visit(steps, [&](Float& step) { step = step * Float(1.0f / one); });
  return steps;
}

}  // namespace nacre
