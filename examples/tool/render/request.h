#pragma once

#include <vector>

#include "examples/tool/output_files.h"
#include "examples/tool/render/options.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Puts into RenderOptions::settings what other options say in words. Errors for what is none of
/// them, or does not go together.
void complete_request(RenderOptions& options, Diagnostics& diagnostics);

/// What is to be written; --out first.
std::vector<OutputFile> outputs_of(const RenderOptions& options);

/// Whether several pictures, of these frames, have names and a checkpoint of their own; an error
/// otherwise.
bool check_series(const RenderOptions& options, const std::vector<int>& frames,
                  Diagnostics& diagnostics);

}  // namespace nacre::tool
