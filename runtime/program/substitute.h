#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/program/recorder.h"

namespace nacre {

/// What stands for an input channel; nothing for one that stays.
using Substitute = std::function<std::optional<Ref>(std::string_view channel)>;

/// Recorded values as they were if other values stood for some input channels. What depends on
/// those is recorded once more, regions whole; the rest is shared, and what is kept is no longer
/// marked so. At top level; `values` and substitutes are from there or literals.
std::vector<Ref> substitute(Recorder& recorder, std::span<const Ref> values,
                            const Substitute& by_channel);

}  // namespace nacre
