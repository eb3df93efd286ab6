#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "jit/tune/recorded_points.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Where errors of materials are measured, if not anywhere.
struct RecordedOption {
  std::string file;  ///< What `nacre render --record-points` wrote; "": none.

  void add(CLI::App& command);
  /// False after an error; null where no file is named.
  bool read(std::shared_ptr<const RecordedPoints>& points, Diagnostics& diagnostics) const;
};

}  // namespace nacre::tool
