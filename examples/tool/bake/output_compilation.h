#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>

#include "examples/tool/options.h"
#include "jit/graph/graph.h"

namespace nacre::tool {

/// An output that is compiled, and whose images are read, while its owner does something else: the
/// one before it is baked. Destroying it waits.
class OutputCompilation {
 public:
  /// Begins, as the profile and `shader` say; without a thread it is done by finish(). What is
  /// opened outlives this.
  OutputCompilation(const Opened& opened, const std::string& output, const ShaderOptions& shader);

  /// Null pointers after an error.
  struct Result {
    std::optional<Graph> graph;
    std::unique_ptr<OutputKernel> kernel;
  };
  /// Once: waits, and says what there is to say, but nothing that has been said.
  Result finish(Diagnostics& diagnostics);
  /// What it is compiled as.
  const ShaderOptions& shader() const { return shader_; }

 private:
  struct Made {
    Result result;
    Diagnostics said;
  };
  Made make(const Opened& opened, const std::string& output) const;

  Diagnostics said_;  ///< Before it began.
  ShaderOptions shader_;
  std::future<Made> made_;
};

}  // namespace nacre::tool
