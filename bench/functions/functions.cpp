#include <array>
#include <string>
#include <vector>

#include "bench/accuracy/math_function.h"
#include "bench/common/benchmarks.h"
#include "bench/common/system.h"

namespace nacre::bench {

namespace {

/// What `fast` is allowed; bench/accuracy has the exact figures.
constexpr Tolerance tolerance{.absolute = 1.5e-4, .relative = 1.5e-4, .outliers = 0.0};

std::vector<Variant> variants() {
  std::vector<Variant> list{{.backend = Backend::interpreter}};
  for (const Accuracy accuracy : {Accuracy::precise, Accuracy::standard, Accuracy::fast}) {
    for (const int lanes : {1, 16}) list.push_back({.lanes = lanes, .accuracy = accuracy});
  }
  return list;
}

}  // namespace

void register_benchmarks() {
  for (const MathFunction& function : math_functions()) {
    const auto make = [function](const CompileOptions& options,
                                 std::string& error) -> std::unique_ptr<KernelRun> {
      Diagnostics diagnostics;
      auto kernel = compile(program_of(function), options, &compile_service(), diagnostics);
      error = diagnostics.to_string();
      if (kernel == nullptr) return nullptr;
      return std::make_unique<KernelRun>(BoundKernel(std::move(kernel), nullptr));
    };
    register_kernel("functions/" + std::string(function.name), variants(), make, tolerance);
  }
}

}  // namespace nacre::bench
