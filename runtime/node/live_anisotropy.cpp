#include "runtime/node/live_anisotropy.h"

#include <string_view>

namespace nacre {

namespace {

constexpr std::string_view slot = "max_anisotropy";

}  // namespace

void offer_live_anisotropy(Recorder& recorder, int max_anisotropy) {
  recorder.parameter(slot, Scalar::i32, static_cast<std::uint32_t>(max_anisotropy));
}

std::optional<Int> live_anisotropy(Recorder& recorder, int most) {
  if (most <= 1 || !recorder.has_leaf(slot)) return std::nullopt;
  const Int asked(recorder.parameter(slot, Scalar::i32, static_cast<std::uint32_t>(most)));
  return min(max(asked, Int(1)), Int(most));
}

}  // namespace nacre
