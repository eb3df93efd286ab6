#include "examples/bake/point_shader.h"

#include <algorithm>
#include <bit>

#include "examples/bake/plane.h"
#include "runtime/channel/channel_name.h"

namespace nacre::host {

namespace {

std::unique_ptr<SurfacePoints> surface_of(const BakeSettings& settings, const Program& program) {
  if (settings.surface != nullptr) return settings.surface->points(settings, program);
  return std::make_unique<Plane>(settings.width, settings.height, area_of(settings));
}

}  // namespace

PointShader::PointShader(const OutputKernel& kernel, std::size_t output,
                         const BakeSettings& settings)
    : kernel_(kernel),
      output_(kernel.outputs[output]),
      width_(settings.width),
      height_(settings.height),
      in_frame_(settings.in_frame),
      surface_(surface_of(settings, kernel.kernel.program())),
      parameters_(kernel.kernel.parameters()),
      inputs_(kernel.kernel.program().inputs.size()),
      in_(inputs_.size()),
      outputs_(kernel.kernel.program().outputs.size()),
      results_(static_cast<std::size_t>(component_count(output_.type))) {
  set("frame", settings.frame);
  set("time", settings.time);
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    inputs_[i].is_constant = surface_->is_constant(kernel.kernel.program().inputs[i].name);
  }
}

void PointShader::set(std::string_view name, float value) {
  if (const auto index = kernel_.kernel.parameter_index(name)) {
    parameters_[*index] = std::bit_cast<std::uint32_t>(value);
  }
}

bool PointShader::reads_footprints() const {
  return std::ranges::any_of(kernel_.kernel.program().inputs, [](const Channel& channel) {
    return parse_derivative(parse_channel(channel.name).group).has_value();
  });
}

std::size_t PointShader::points_of_a_run() const {
  constexpr std::size_t operations = std::size_t{1} << 28;
  const std::size_t points =
      operations / std::max<std::size_t>(1, instruction_count(kernel_.kernel.program()));
  return std::clamp<std::size_t>(points, 256, 16384);
}

void PointShader::fill(const TexelPoints& points) {
  const Program& program = kernel_.kernel.program();
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    Input& input = inputs_[i];
    const bool is_there = input.is_constant && input.footprint == points.footprint &&
                          input.values.size() >= points.x.size();
    if (!is_there) {
      surface_->fill(program.inputs[i].name, points, input.values);
      if (program.inputs[i].type != Scalar::f32) {
        for (float& value : input.values) {
          value = std::bit_cast<float>(static_cast<std::int32_t>(value));
        }
      }
    }
    input.footprint = points.footprint;
    in_[i] = input.values.data();
  }
}

RunStatus PointShader::run(const TexelPoints& points, const std::atomic<std::uint32_t>& stop) {
  const Program& program = kernel_.kernel.program();
  const std::size_t count = points.x.size();
  on_surface_ = surface_->place(points);
  fill(points);
  std::vector<void*> out(outputs_.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t component = i - output_.first_channel;
    const bool is_ours = i >= output_.first_channel && component < results_.size();
    std::vector<float>& values = is_ours ? results_[component] : outputs_[i];
    values.resize(count);
    out[i] = values.data();
  }
  const RunStatus status = kernel_.kernel.run(in_, out, count, parameters_, &stop);
  if (status != RunStatus::done) return status;
  for (std::size_t c = 0; c < results_.size(); ++c) {
    if (program.outputs[output_.first_channel + c].type == Scalar::f32) continue;
    for (float& value : results_[c]) {
      value = static_cast<float>(std::bit_cast<std::int32_t>(value));
    }
  }
  if (in_frame_) surface_->turn_into_frame({results_[0], results_[1], results_[2]});
  return RunStatus::done;
}

}  // namespace nacre::host
