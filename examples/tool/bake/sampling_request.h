#pragma once

#include <string>

#include "examples/bake/bake.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// What the command line says about samples in a texel.
struct SamplingRequest {
  static constexpr int most_samples = 65536;

  std::string samples = "1";  ///< --samples: a number, or "auto".
  float texel_error = host::Sampling{}.error;
  bool has_error = false;  ///< --texel-error was given.

  void add(CLI::App& command);
  /// False, with an error, if what was given cannot be understood.
  bool read(host::Sampling& sampling, Diagnostics& diagnostics) const;
};

/// Says so where an output that has no mean was to have more than one sample in a texel.
void warn_of_no_mean(const host::Sampling& sampling, Type type, const SourceLocation& where,
                     Diagnostics& diagnostics);

}  // namespace nacre::tool
