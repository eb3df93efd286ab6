#include "examples/tool/render/kernel_light.h"

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

KernelLight::KernelLight(std::unique_ptr<OutputKernel> kernel, RenderStop& stop)
    : kernel_(std::move(kernel)), stop_(stop) {
  const Program& program = kernel_->kernel.program();
  for (const Channel& channel : program.inputs) {
    const auto parsed = parse_channel(channel.name);
    const int i = parsed.component;
    if (parsed.group == "P") {
      inputs_.emplace_back([i](const host::ShadingBatch& batch) { return component(batch.P, i); });
    } else {
      const auto lanes =
          parsed.group == "time" ? &host::ShadingBatch::times : &host::ShadingBatch::frames;
      inputs_.emplace_back([lanes](const host::ShadingBatch& batch) { return batch.*lanes; });
    }
  }
  const std::size_t own = kernel_->outputs.front().name.size() + 1;  // "L." of "L.direction.x".
  for (const Channel& channel : program.outputs) {
    const auto parsed = parse_channel(std::string_view(channel.name).substr(own));
    const int i = parsed.component;
    if (parsed.group == "distance") {
      outputs_.emplace_back([](const host::LightLanes& out) { return out.distance; });
      continue;
    }
    const auto lanes =
        parsed.group == "intensity" ? &host::LightLanes::intensity : &host::LightLanes::direction;
    outputs_.emplace_back(
        [lanes, i](const host::LightLanes& out) { return component(out.*lanes, i); });
  }
  time_ = kernel_->kernel.parameter_index("time");
  frame_ = kernel_->kernel.parameter_index("frame");
}

void KernelLight::light(const host::ShadingBatch& batch, host::LightLanes out) const {
  std::vector<const void*> inputs;
  for (const auto& input : inputs_) inputs.push_back(input(batch));
  std::vector<void*> outputs;
  for (const auto& output : outputs_) outputs.push_back(output(out));
  std::fill_n(out.distance, batch.count, INFINITY);  // Of lights that are nowhere it is no channel.
  std::vector<std::uint32_t> parameters = kernel_->kernel.parameters();
  if (time_) parameters[*time_] = std::bit_cast<std::uint32_t>(batch.time);
  if (frame_) parameters[*frame_] = std::bit_cast<std::uint32_t>(batch.frame);
  const RunStatus status =
      kernel_->kernel.run(inputs, outputs, batch.count, parameters, &stop_.flag());
  if (status == RunStatus::done) return;
  // As KernelShader: there will be no image.
  for (void* output : outputs) std::memset(output, 0, batch.count * sizeof(float));
  if (status == RunStatus::stopped) return;
  failed_ = true;
  stop_.request();
}

}  // namespace nacre::tool
