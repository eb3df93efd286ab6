#pragma once

#include <optional>
#include <string>

#include "jit/tune/tune.h"

namespace nacre {

/// How far kernels are from what is right, and where that was found.
struct MeasuredError {
  Error error;
  std::string points;  ///< For people.
};

/// Of what options.shader asks for, by options.metric, at points by which tune() does not choose.
/// Nothing, with a diagnostic, where it cannot be compiled or there is nothing to compare.
std::optional<MeasuredError> measure_error(const TuneSubject& subject, const TuneOptions& options,
                                           Diagnostics& diagnostics);

}  // namespace nacre
