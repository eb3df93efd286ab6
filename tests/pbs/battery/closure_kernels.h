#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jit/shading/shading_system.h"
#include "tests/pbs/battery/closure_case.h"

namespace nacre {

/// An input of the closure under test or of one within it; each number of it is a channel.
struct ClosureInput {
  std::string name;  ///< "n/roughness", "n/in1/roughness"; components as channel_text() has them.
  Type type = Type::none;
  Meaning meaning = Meaning::any;
};

/// Arrays by channel, as the four-byte elements that kernels read and write.
using Arrays = std::map<std::string, std::vector<std::uint32_t>, std::less<>>;

/// The system of the test program, with the data library.
ShadingSystem& closure_system();

/// How the kernels of a closure are compiled.
struct ClosureWay {
  Accuracy accuracy = Accuracy::standard;
  Backend backend = Backend::jit;
  /// With all that a host may ask for: lobes wanted at points, transport, min_alpha, lobe_mask, no
  /// more light than arrives, light followed below the surface, what each lobe gives, the index
  /// around.
  bool asks_all = false;
};
/// "standard", "fast_asking_all".
std::string to_string(const ClosureWay& way);

/// What one form of a row is compiled to, every number of its inputs a channel. Closures within it
/// are simple ones whose inputs are channels too.
struct ClosureKernels {
  ClosureWay way;
  std::vector<ClosureInput> inputs;
  std::unique_ptr<MaterialKernels> material;  ///< Of a BSDF, EDF or surface shader.
  std::unique_ptr<OutputKernel> values;       ///< Of a medium, volume, displacement or light.
  Diagnostics diagnostics;                    ///< Why there is neither.
};
ClosureKernels compile_closure(const ClosureCase& row, const std::vector<Setting>& form,
                               const ClosureWay& way);

/// "scatter_mode=RT distribution=ggx"; "defaults".
std::string to_string(const std::vector<Setting>& form);

/// Runs a kernel over `count` points. A channel that `in` lacks fails the running test.
Arrays run(const BoundKernel& kernel, const Arrays& in, std::size_t count);

}  // namespace nacre
