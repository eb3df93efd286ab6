#pragma once

#include <nacre/nacre.h>

#include <memory>
#include <string>

#include "jit/tune/measure.h"

namespace nacre::api {

/// How far a shader is off, and what was chosen so that it is no more than that.
struct ShaderError {
  MeasuredError measured;
  Metric metric;
  std::string profile;  ///< Empty: nothing was chosen.
};

/// Has options of a subject ask for what its profile says, or for the cheapest that keeps the error
/// that its host allows. False, with a diagnostic, where there is none, or a text cannot be read.
/// `error`: what was measured, where that was asked for; else null.
bool choose_exactness(const nacre_compile_options& asked, const TuneSubject& subject,
                      ShaderOptions& options, std::shared_ptr<const ShaderError>& error,
                      Diagnostics& diagnostics);

}  // namespace nacre::api
