// How exact functions are, and the sums that closures take.
#include <array>

#include "jit/tune/dimensions/list.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 3> settings{"precise", "standard", "fast"};

void apply(std::size_t setting, ShaderOptions& options) {
  constexpr std::array values{Accuracy::precise, Accuracy::standard, Accuracy::fast};
  options.compile.accuracy = values[setting];
}

}  // namespace

constinit const Dimension accuracy_dimension{
    "accuracy", "error of functions and of what closures sum", settings, apply};

}  // namespace nacre
