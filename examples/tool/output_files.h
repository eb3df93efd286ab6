#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"

namespace nacre {
class BoundKernel;
}

namespace nacre::tool {

/// A file that a command is asked to write; "": none.
struct OutputFile {
  std::string option;  ///< That asks for it: "--plot".
  std::string file;
};

/// False, with an error for each, where two of them are one file, or one is a file that the command
/// reads: what is lost so cannot be had back. What is no file (/dev/null) may be anything.
bool check_outputs(std::span<const OutputFile> outputs, const std::vector<std::string>& read,
                   Diagnostics& diagnostics);

/// The same of a file and what kernels read.
bool check_output(const OutputFile& output, std::span<const BoundKernel* const> kernels,
                  Diagnostics& diagnostics);

}  // namespace nacre::tool
