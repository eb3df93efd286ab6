#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "jit/compile/compile.h"
#include "jit/tune/kernel_run.h"

namespace nacre::bench {

/// Every benchmark program defines it; bench/common/main.cpp calls it.
void register_benchmarks();

/// How a kernel is made: what the names of benchmarks end with.
struct Variant {
  Backend backend = Backend::jit;
  int lanes = 16;  ///< JIT only.
  Accuracy accuracy = Accuracy::standard;

  CompileOptions options() const;
  std::string name() const;  ///< "jit_w16/standard", "interpreter/standard"
};

/// The JIT at W = 1, 4, 8, 16 and the interpreter in standard, and the JIT's best in the
/// other modes. `quick`: W = 1, 16 and the interpreter in standard.
std::vector<Variant> all_variants();
std::vector<Variant> quick_variants();

/// Differences that rounding explains: |x - y| <= absolute + relative |y|; this share of
/// the points may differ more (the other side of a step, a hash of a rounded number).
struct Tolerance {
  double absolute = 1e-4;
  double relative = 1e-3;
  double outliers = 0.005;
};

/// Makes a kernel with its arguments; null, with the reason, where it can't.
using MakeRun = std::function<std::unique_ptr<KernelRun>(const CompileOptions&, std::string&)>;

/// One benchmark "<name>/<variant>" for each variant, ns a point as items. Before it
/// is timed its results are compared with those of the reference engine, computed
/// once for all variants of an accuracy; a wrong kernel is reported, not timed. Counters
/// "ulps_99" and "ulps_most" say how far 99 % of the results of a right one are from those,
/// and how far the worst is.
void register_kernel(const std::string& name, const std::vector<Variant>& variants,
                     const MakeRun& make, const Tolerance& tolerance = {});

/// Compares outputs by channel; empty, or what differs most.
std::string difference(const Columns& found, const Columns& expected, const Tolerance& tolerance);

}  // namespace nacre::bench
