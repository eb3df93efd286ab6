#include "examples/tool/kernel_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "runtime/channel/channel_name.h"

namespace nacre::tool {

namespace {

float* component(const host::Lanes3& lanes, int i) {
  return i == 0 ? lanes.x : i == 1 ? lanes.y : lanes.z;
}

/// "direction.x" of "L.direction.x".
std::string_view own_name(const std::string& channel, const std::string& light) {
  return std::string_view(channel).substr(light.size() + 1);
}

}  // namespace

bool has_place(const Program& light) {
  return std::ranges::any_of(light.outputs, [](const Channel& output) {
    return output.name == "direction.x" || output.name.ends_with(".direction.x");
  });
}

std::unique_ptr<KernelLight> KernelLight::create(std::unique_ptr<OutputKernel> kernel,
                                                 RenderStop& stop, Diagnostics& diagnostics) {
  const OutputKernel::Output& output = kernel->outputs.front();
  for (const Channel& channel : kernel->kernel.program().inputs) {
    const std::string_view group = parse_channel(channel.name).group;
    if (group == "P" || group == "time" || group == "frame") continue;
    diagnostics.error("light-reads-surface", output.where,
                      "a light reads more of the points that it lights than where they are", "P",
                      channel.name);
    return nullptr;
  }
  return std::unique_ptr<KernelLight>(new KernelLight(std::move(kernel), stop));
}

void KernelLight::light(const host::ShadingBatch& batch, host::LightLanes out) const {
  const Program& program = kernel_->kernel.program();
  const std::string& name = kernel_->outputs.front().name;
  std::vector<const void*> inputs;
  for (const Channel& channel : program.inputs) {
    const auto [group, i] = parse_channel(channel.name);
    inputs.push_back(group == "P"      ? component(batch.P, i)
                     : group == "time" ? batch.times
                                       : batch.frames);
  }
  for (std::uint32_t i = 0; i < batch.count; ++i) out.distance[i] = INFINITY;
  std::vector<void*> outputs;
  for (const Channel& channel : program.outputs) {
    const auto [group, i] = parse_channel(own_name(channel.name, name));
    outputs.push_back(group == "intensity"   ? component(out.intensity, i)
                      : group == "direction" ? component(out.direction, i)
                                             : out.distance);
  }
  std::vector<std::uint32_t> parameters = kernel_->kernel.parameters();
  if (const auto slot = kernel_->kernel.parameter_index("time")) {
    parameters[*slot] = std::bit_cast<std::uint32_t>(batch.time);
  }
  if (const auto slot = kernel_->kernel.parameter_index("frame")) {
    parameters[*slot] = std::bit_cast<std::uint32_t>(batch.frame);
  }
  const RunStatus status =
      kernel_->kernel.run(inputs, outputs, batch.count, parameters, &stop_.flag());
  if (status == RunStatus::done) return;
  for (void* output : outputs) std::memset(output, 0, batch.count * sizeof(float));
  if (status == RunStatus::stopped) return;
  failed_ = true;
  stop_.request();
}

}  // namespace nacre::tool
