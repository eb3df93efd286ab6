// How many looks at an image stand for a footprint that is longer than wide.
#include <array>

#include "jit/tune/dimensions/list.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 6> settings{"32", "16", "8", "4", "2", "1"};

void apply(std::size_t setting, ShaderOptions& options) {
  constexpr std::array values{32, 16, 8, 4, 2, 1};
  options.max_anisotropy = values[setting];
}

}  // namespace

constinit const Dimension anisotropy_dimension{
    "anisotropy", "how much longer than wide a footprint may be on an image without blur", settings,
    apply};

}  // namespace nacre
