// Whether noise is computed that a point's extent does not resolve.
#include <array>

#include "jit/tune/dimensions/list.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 2> settings{"all", "resolved"};

void apply(std::size_t setting, ShaderOptions& options) { options.fade_noise = setting == 1; }

}  // namespace

constinit const Dimension noise_dimension{
    "noise", "noise of cells that the extent of a point covers", settings, apply};

}  // namespace nacre
