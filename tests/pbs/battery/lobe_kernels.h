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

/// The kernels of one lobe, white, as a surface has them: what a view needs is worked out once, by
/// a kernel `begin`, and the others load it.
class LobeKernels {
 public:
  /// `reverse_pdf`: else none is computed, which is much less work for lobes that sum over facets.
  LobeKernels(const LobeCase& row, Accuracy accuracy, Backend backend = Backend::jit,
              bool reverse_pdf = false);

  Evaluated evaluate(float roughness, Direction wo, const std::vector<Direction>& wi) const;
  /// Each from its own side: wo.size() == wi.size().
  Evaluated evaluate(float roughness, const std::vector<Direction>& wo,
                     const std::vector<Direction>& wi) const;
  Sampled sample(float roughness, Direction wo, std::size_t count, std::uint64_t seed) const;
  double albedo(float roughness, Direction wo) const;

 private:
  /// Channels for views, with the state of each.
  Columns viewed(float roughness, const std::vector<Direction>& wo) const;

  std::shared_ptr<const Kernel> begin_, evaluate_, sample_, albedo_;
};

/// Records a lobe and slices its kernels.
struct LobePrograms {
  Program begin, evaluate, sample, albedo;
};
struct LobeRequest {
  bool hostile = false;  ///< Weight and normal are channels as well.
  bool reverse_pdf = true;
  Keeps keeps = Keeps::pass;  ///< `load`: what `begin` stores.
};
LobePrograms lobe_programs(const LobeCase& row, Accuracy accuracy, const LobeRequest& wanted = {});

/// Fails the running test where there is no kernel.
std::shared_ptr<const Kernel> lobe_kernel(Program program, Accuracy accuracy,
                                          Backend backend = Backend::jit);

/// Channels for a white lobe at this roughness; normal z, tangent x.
Columns lobe_columns(float roughness);
void set_directions(Columns& columns, const std::string& name, const std::vector<Direction>& w);
/// Channels u.x, u.y, u.z in [0, 1).
void set_random(Columns& columns, std::size_t count, std::uint64_t seed);

}  // namespace nacre
