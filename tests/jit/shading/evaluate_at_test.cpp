#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "jit/graph/build/builder.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

using Lanes = std::vector<float>;

std::vector<Lanes> run(const BoundKernel& kernel, const std::vector<Lanes>& inputs,
                       std::size_t count, std::span<const std::uint32_t> parameters = {}) {
  std::vector<const void*> in;
  for (const Lanes& lanes : inputs) in.push_back(lanes.data());
  std::vector<Lanes> outputs(kernel.program().outputs.size(), Lanes(count));
  std::vector<void*> out;
  for (Lanes& lanes : outputs) out.push_back(lanes.data());
  EXPECT_EQ(kernel.run(in, out, count, parameters), RunStatus::done);
  return outputs;
}

/// A frame that looks along +z with the viewer at 40 degrees.
float geometry(const std::string& channel) {
  if (channel == "N.z" || channel == "T.x" || channel == "B.y") return 1.0f;
  if (channel == "wo.x") return std::sin(0.7f);
  if (channel == "wo.z") return std::cos(0.7f);
  return 0.0f;
}

/// One point and many directions give what the point repeated for every
/// direction gives, to the bit: both are the same operations.
TEST(EvaluateAt, AgreesWithEvaluateToTheBit) {
  Diagnostics diagnostics;
  const auto system =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  ASSERT_NE(system, nullptr) << diagnostics.to_string();
  GraphBuilder builder(system->library());
  const auto node = builder.add_node("ND_standard_surface_surfaceshader", "surface");
  builder.set(node, "coat", {Type::float_, {0.7f}, {}, {}});
  builder.output("surfaceshader", node);
  ShaderOptions options;
  options.kernels.entries |= entry_evaluate_at;
  options.compile.accuracy = Accuracy::precise;
  const auto graph = builder.finish(system->graph_options(options), diagnostics);
  ASSERT_TRUE(graph.has_value()) << diagnostics.to_string();
  const auto kernels = system->compile_material(*graph, options, diagnostics);
  ASSERT_NE(kernels, nullptr) << diagnostics.to_string();

  constexpr std::size_t count = 37;
  std::vector<Lanes> begin_inputs;
  for (const Channel& channel : kernels->begin->program().inputs) {
    begin_inputs.emplace_back(count, geometry(channel.name));
  }
  const std::vector<Lanes> state = run(*kernels->begin, begin_inputs, count);

  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::vector<Lanes> wi(3, Lanes(count));
  for (std::size_t i = 0; i < count; ++i) {
    const float x = normal(random), y = normal(random), z = std::fabs(normal(random));
    const float length = std::sqrt(x * x + y * y + z * z);
    wi[0][i] = x / length, wi[1][i] = y / length, wi[2][i] = z / length;
  }
  const auto lanes_of = [&](const std::string& channel) -> Lanes {
    if (channel.starts_with("wi.")) return wi[static_cast<std::size_t>(channel[3] - 'x')];
    const auto& outputs = kernels->begin->program().outputs;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      if (outputs[k].name == channel) return state[k];
    }
    return Lanes(count, geometry(channel));
  };
  std::vector<Lanes> inputs;
  for (const Channel& channel : kernels->evaluate->program().inputs) {
    inputs.push_back(lanes_of(channel.name));
  }
  const auto expected = run(*kernels->evaluate, inputs, count);

  std::vector<Lanes> at_inputs;
  for (const Channel& channel : kernels->evaluate_at->program().inputs) {
    ASSERT_TRUE(channel.name.starts_with("wi.")) << channel.name;
    at_inputs.push_back(lanes_of(channel.name));
  }
  std::vector<std::uint32_t> block;
  for (const ParameterSlot& slot : kernels->evaluate_at->program().parameters) {
    block.push_back(std::bit_cast<std::uint32_t>(lanes_of(slot.name)[0]));
  }
  EXPECT_EQ(run(*kernels->evaluate_at, at_inputs, count, block), expected);
}

}  // namespace
}  // namespace nacre
