#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "jit/compile/fitted_numbers.h"
#include "jit/record/textures.h"
#include "jit/service/compile_service.h"
#include "runtime/kernel.h"

namespace nacre {

/// Machine code with all that it needs but arrays: for hosts that call it many times for few
/// points. Shared by any number of threads.
struct BoundCode {
  /// `count`: a multiple of code.lanes. In the environment of ScopedFloatEnvironment, which the
  /// caller sets.
  RunStatus run(const void* const* inputs, void* const* outputs, std::uint64_t count) const;

  CompiledKernel::Code code;
  std::vector<std::uint32_t> parameters;
  std::shared_ptr<const FittedNumbers> fitted;  ///< Null: nothing is.
  RecordedTextures::Snapshot images;
  KernelArguments arguments;  ///< Of them.
  std::shared_ptr<const Kernel> kernel;
  std::shared_ptr<const RecordedTextures> textures;
};

}  // namespace nacre
