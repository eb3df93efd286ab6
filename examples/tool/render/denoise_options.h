#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "examples/render/denoise.h"
#include "examples/render/passes.h"

namespace nacre::tool {

/// Whether a picture is denoised, and by what.
struct DenoiseOptions {
  bool is_asked = false;
  std::string library;  ///< Its file; "": that of the system.

  void add(CLI::App& command);
};

/// Adds the passes that a denoiser reads.
void ask_for_guides(const DenoiseOptions& options, host::PassRequest& passes);

}  // namespace nacre::tool
