// Whether points have an extent, over which images and derivatives are taken.
#include <array>

#include "jit/tune/dimensions/list.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 2> settings{"yes", "no"};

void apply(std::size_t setting, ShaderOptions& options) { options.footprints = setting == 0; }

}  // namespace

constinit const Dimension footprints_dimension{
    "footprints", "whether images are filtered by the extent of a point", settings, apply};

}  // namespace nacre
