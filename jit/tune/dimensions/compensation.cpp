// Light that several scatterings between facets bring back.
#include <array>

#include "jit/tune/dimensions/list.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 3> settings{"all", "reflection", "nothing"};

void apply(std::size_t setting, ShaderOptions& options) {
  constexpr std::array values{Compensation::all, Compensation::reflection, Compensation::nothing};
  options.kernels.compensation = values[setting];
}

}  // namespace

constinit const Dimension compensation_dimension{
    "compensation", "light that several scatterings between facets bring back", settings, apply};

}  // namespace nacre
