#pragma once

#include <map>
#include <memory>
#include <nacre/lobe_test/direction.hpp>
#include <string>
#include <vector>

#include "jit/shading/shading_system.h"
#include "tests/pbs/edf/emission_case.h"

namespace nacre {

/// Columns by channel; a column of one number stands for as many as needed.
using EmissionColumns = std::map<std::string, std::vector<float>>;

/// The kernels `emission` and `emit` of a material.
class EmissionKernels {
 public:
  EmissionKernels(const EmissionCase& row, const ShaderOptions& options);

  /// At a point whose axes are these: `emitted`, `weight`, `pdf`.
  EmissionColumns emit(const EmissionColumns& point, std::size_t count, std::uint64_t seed) const;
  /// `emission` and `pdf`, seen from there.
  EmissionColumns emission(EmissionColumns point, const std::vector<Direction>& wo) const;

  const MaterialKernels& material() const { return *material_; }
  static EmissionColumns run(const BoundKernel& kernel, const EmissionColumns& in,
                             std::size_t count);

 private:
  std::unique_ptr<MaterialKernels> material_;
};

/// Both kernels, and no others.
ShaderOptions emission_options(Accuracy accuracy, Backend backend = Backend::jit, int lanes = 0);

/// The normal along z, for shading and of the surface; or these apart.
EmissionColumns upright_point();
EmissionColumns tilted_point();

Direction direction_of(const EmissionColumns& columns, const std::string& group, std::size_t i);

}  // namespace nacre
