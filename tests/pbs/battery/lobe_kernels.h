#pragma once

#include <memory>
#include <nacre/lobe_test/direction.hpp>
#include <vector>

#include "jit/compile/options.h"
#include "runtime/kernel.h"
#include "runtime/reference/reference.h"
#include "tests/pbs/battery/lobe_case.h"
#include "tests/support/run_kernel.h"

namespace nacre {

struct Evaluated {
  std::vector<float> f, pdf, pdf_reverse;  ///< f: red, times the cosine.
};
struct Sampled {
  std::vector<Direction> wi;
  std::vector<float> weight, pdf, pdf_reverse;
  std::vector<bool> valid;
};

/// The kernels of one lobe, white, as a surface has them.
class LobeKernels {
 public:
  LobeKernels(const LobeCase& row, Accuracy accuracy, Backend backend = Backend::jit);

  Evaluated evaluate(float roughness, Direction wo, const std::vector<Direction>& wi) const;
  /// Each from its own side: wo.size() == wi.size().
  Evaluated evaluate(float roughness, const std::vector<Direction>& wo,
                     const std::vector<Direction>& wi) const;
  Sampled sample(float roughness, Direction wo, std::size_t count, std::uint64_t seed) const;
  double albedo(float roughness, Direction wo) const;

  const Kernel& evaluate_kernel() const { return *evaluate_; }
  const Kernel& sample_kernel() const { return *sample_; }

 private:
  std::shared_ptr<const Kernel> evaluate_, sample_, albedo_;
};

/// Records a lobe and slices its kernels. `more` replaces ports.
struct LobePrograms {
  Program evaluate, sample, albedo;
};
LobePrograms lobe_programs(const LobeCase& row, Accuracy accuracy, bool hostile = false);

/// Fails the running test where there is no kernel.
std::shared_ptr<const Kernel> lobe_kernel(Program program, Accuracy accuracy,
                                          Backend backend = Backend::jit);

/// Channels for a white lobe at this roughness; normal z, tangent x.
Columns lobe_columns(float roughness);
void set_directions(Columns& columns, const std::string& name, const std::vector<Direction>& w);
/// Channels u.x, u.y, u.z in [0, 1).
void set_random(Columns& columns, std::size_t count, std::uint64_t seed);

}  // namespace nacre
