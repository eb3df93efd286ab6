// Whether what lobes work out for a view comes of tables, and how exact these and others are.
#include <array>

#include "jit/tune/dimensions/list.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 4> settings{"usual", "1e-4", "1e-3", "1e-2"};

void apply(std::size_t setting, ShaderOptions& options) {
  constexpr std::array values{0.0, 1e-4, 1e-3, 1e-2};
  options.kernels.table_error = values[setting];
  options.compile.table_error.reset();  // What the accuracy is worth.
  if (setting > 0) options.compile.table_error = values[setting];
}

}  // namespace

constinit const Dimension tables_dimension{
    "tables", "error of tables in place of what depends on one number, or on the view", settings,
    apply};

}  // namespace nacre
