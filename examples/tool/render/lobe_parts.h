#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "examples/render/shader.h"
#include "pbs/kernels.h"
#include "runtime/program/program.h"

namespace nacre::tool {

/// What each lobe gives of a kernel's result (KernelRequest::by_lobe), by the classes that passes
/// tell apart.
class LobeParts {
 public:
  LobeParts() = default;
  /// `result`: "f" or "weight". Without outputs of lobes, empty.
  LobeParts(const Program& program, std::string_view result, const std::vector<LobeInfo>& lobes);

  /// Outputs of lobes, which follow those of the whole.
  std::size_t count() const { return 3 * classes_.size(); }

  /// Sums of the outputs `lobes`, `stride` floats apart, for directions `wi`. `flags`: of a sample;
  /// null: of an evaluation.
  void add(const host::ShadingBatch& batch, host::Lanes3 wi, const std::uint32_t* flags,
           const float* lobes, std::size_t stride, const host::PartLanes& parts) const;

 private:
  /// Of each lobe, what it is of where light stays on its side.
  std::vector<host::ScatterClass> classes_;
};

}  // namespace nacre::tool
