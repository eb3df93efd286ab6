#include "examples/tool/render/kernel_shader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <map>

#include "examples/render/batch_channels.h"
#include "runtime/channel/channel_name.h"

namespace nacre::tool {

static_assert(int{host::diffuse_reflection} == lobe_diffuse_reflection &&
              int{host::glossy_reflection} == lobe_glossy_reflection &&
              int{host::diffuse_transmission} == lobe_diffuse_transmission &&
              int{host::glossy_transmission} == lobe_glossy_transmission &&
              int{host::delta_reflection} == lobe_delta_reflection &&
              int{host::delta_transmission} == lobe_delta_transmission);

using host::Lanes3;
using host::ShadingBatch;

bool has_medium(const MaterialKernels& kernels) {
  if (!kernels.interior) return false;
  return std::ranges::any_of(kernels.interior->program().outputs, [](const Channel& output) {
    return parse_channel(output.name).group == "absorption";
  });
}

KernelShader::KernelShader(std::unique_ptr<MaterialKernels> kernels, RenderStop& stop,
                           bool is_nested, const std::vector<host::GraphValue>& values,
                           bool records)
    : kernels_(std::move(kernels)), stop_(stop) {
  if (records) recorder_ = std::make_unique<PointRecorder>();
  capabilities_.scatters = kernels_->sample.has_value() && kernels_->evaluate.has_value();
  // Of a lightmaterial what its mesh emits.
  std::optional<BoundKernel>& emitted =
      kernels_->has_surface || !kernels_->light ? kernels_->emission : kernels_->light;
  capabilities_.emits = emitted.has_value();
  capabilities_.has_opacity = kernels_->opacity.has_value();
  capabilities_.has_interior = is_nested ? lets_in() : has_medium(*kernels_);
  bind(kernels_->begin, begin_, {});
  bind(kernels_->sample, sample_, {"u.x", "u.y", "u.z"});
  bind(kernels_->evaluate, evaluate_, {"wi.x", "wi.y", "wi.z"});
  bind(emitted, emission_, {});
  bind(kernels_->opacity, opacity_, {});
  if (capabilities_.has_interior) bind(kernels_->interior, interior_, {});
  capabilities_.displaces = kernels_->displacement.has_value();
  capabilities_.is_volume = !kernels_->has_surface && kernels_->has_volume;
  if (capabilities_.is_volume && kernels_->volume) {
    capabilities_.volume_varies = !kernels_->volume->program().inputs.empty();
    bind(kernels_->volume, volume_, {});
  }
  bind(kernels_->displacement, displacement_, {});
  capabilities_.has_subsurface = kernels_->subsurface.has_value();
  bind(kernels_->subsurface, subsurface_, {"of_lobe"});
  for (const LobeInfo& lobe : kernels_->lobes) capabilities_.lobes |= lobe.kinds;
  if (kernels_->sample) sample_parts_ = {kernels_->sample->program(), "weight", kernels_->lobes};
  if (kernels_->evaluate) evaluate_parts_ = {kernels_->evaluate->program(), "f", kernels_->lobes};
  find_columns(values);
}

/// Where begin() puts what it stores.
void KernelShader::find_columns(const std::vector<host::GraphValue>& values) {
  if (begin_.kernel == nullptr) return;
  const std::vector<Channel>& outputs = begin_.kernel->program().outputs;
  std::map<std::string, PointColumn> of_point;
  for (const Channel& output : outputs) {
    if (const auto number = state_number(output.name)) {
      const auto slot = std::ranges::find(kernels_->state, *number);
      columns_.push_back(static_cast<std::size_t>(slot - kernels_->state.begin()));
    } else {
      columns_.push_back(kernels_->state.size() + of_point.size());
      of_point.emplace(output.name, PointColumn{columns_.back(), output.type != Scalar::f32});
    }
  }
  const auto add = [&](const std::string& name, int components) {
    for (int k = 0; k < components; ++k) {
      const auto found = of_point.find(components == 1 ? name : channel_text(name, k));
      point_columns_.push_back(found == of_point.end() ? std::nullopt
                                                       : std::optional(found->second));
    }
  };
  add("albedo", 3);
  add("normal", 3);
  add("roughness", 1);
  for (const host::GraphValue& value : values) add(value.name, value.components);
}

void KernelShader::bind(std::optional<BoundKernel>& kernel, Bound& bound,
                        const std::vector<std::string_view>& extras) {
  if (!kernel.has_value()) return;
  bound.kernel = &*kernel;
  bound.frame = kernel->parameter_index("frame");
  bound.time = kernel->parameter_index("time");
  for (const Channel& channel : kernel->program().inputs) {
    const auto extra = std::find(extras.begin(), extras.end(), channel.name);
    bound.extra.push_back(extra == extras.end() ? -1 : static_cast<int>(extra - extras.begin()));
    bound.state.push_back(-1);
    bound.from_batch.emplace_back();
    if (extra != extras.end()) continue;
    if (const auto number = state_number(channel.name)) {
      const auto slot = std::find(kernels_->state.begin(), kernels_->state.end(), *number);
      bound.state.back() = static_cast<int>(slot - kernels_->state.begin());
      continue;
    }
    const auto [group, i] = parse_channel(channel.name);
    reads_uv_ = reads_uv_ || group == "uv0";
    bound.from_batch.back() = host::batch_channel(channel.name, capabilities_);
    if (recorder_ != nullptr) recorder_->want(channel, bound.from_batch.back());
    // A slot named as the property says whether the mesh has it (nodes/geometric).
    if (const auto slot = i < 0 ? std::nullopt : kernel->parameter_index(group)) {
      bound.present.emplace_back(
          *slot, host::request_primvar(host::primvar_name(group), i + 1, capabilities_));
    }
  }
}

std::uint32_t KernelShader::stride(std::uint32_t count) {
  return (count + host::lane_padding - 1) / host::lane_padding * host::lane_padding;
}

std::vector<const BoundKernel*> KernelShader::kernels() const {
  std::vector<const BoundKernel*> all;
  for (const Bound* bound : {&begin_, &sample_, &evaluate_, &emission_, &opacity_, &interior_,
                             &displacement_, &subsurface_, &volume_}) {
    if (bound->kernel != nullptr) all.push_back(bound->kernel);
  }
  return all;
}

std::size_t KernelShader::state_bytes(std::uint32_t capacity) const {
  return std::max(kernels_->state.size(), columns_.size()) * stride(capacity) * sizeof(float);
}

std::vector<std::uint32_t> KernelShader::parameters(const Bound& bound, const ShadingBatch& batch) {
  std::vector<std::uint32_t> block = bound.kernel->parameters();
  if (bound.frame) block[*bound.frame] = std::bit_cast<std::uint32_t>(batch.frame);
  if (bound.time) block[*bound.time] = std::bit_cast<std::uint32_t>(batch.time);
  for (const auto& [slot, primvar] : bound.present) {
    // A slot, as all meshes of the material agree.
    block[slot] = batch.primvars[primvar].present[0] != 0 ? 1u : 0u;
  }
  return block;
}

void KernelShader::run(const Bound& bound, const ShadingBatch& batch, const void* state,
                       std::span<const void* const> extras, std::span<void* const> outputs) const {
  static constexpr std::size_t most = 512;
  const std::size_t count = bound.extra.size();
  assert(count <= most);
  std::vector<float> zeros;  // For attributes that the mesh does not have.
  std::array<const void*, most> inputs;
  for (std::size_t k = 0; k < count; ++k) {
    const void* lanes = nullptr;
    if (bound.extra[k] >= 0) {
      lanes = extras[static_cast<std::size_t>(bound.extra[k])];
    } else if (bound.state[k] >= 0) {
      lanes = static_cast<const float*>(state) +
              static_cast<std::size_t>(bound.state[k]) * stride(batch.count);
    } else if (bound.from_batch[k]) {
      lanes = bound.from_batch[k](batch);
    }
    if (lanes == nullptr && zeros.empty()) zeros.resize(batch.count, 0.0f);
    inputs[k] = lanes != nullptr ? lanes : zeros.data();
  }
  const RunStatus status = bound.kernel->run({inputs.data(), count}, outputs, batch.count,
                                             parameters(bound, batch), &stop_.flag());
  if (status == RunStatus::done) return;
  // The image will not be: what the render goes on with until it ends only has to be sound.
  for (void* output : outputs) std::memset(output, 0, batch.count * sizeof(float));
  if (status == RunStatus::stopped) return;
  failed_ = true;
  stop_.request();
}

/// As run(), with what lobes give; `outputs` are those of the whole. Floats of a lane padded, one
/// output after another.
std::vector<float> KernelShader::run_by_lobe(const Bound& bound, const LobeParts& parts,
                                             const ShadingBatch& batch, const void* state,
                                             std::span<const void* const> extras,
                                             std::span<void* const> outputs) const {
  std::vector<float> lobes(parts.count() * stride(batch.count));
  std::vector<void*> all(outputs.begin(), outputs.end());
  for (std::size_t k = 0; k < parts.count(); ++k) {
    all.push_back(lobes.data() + k * stride(batch.count));
  }
  run(bound, batch, state, extras, all);
  return lobes;
}

void KernelShader::begin(const ShadingBatch& batch, void* state) const {
  if (begin_.kernel == nullptr) return;
  if (recorder_ != nullptr) recorder_->add(batch);
  std::vector<void*> outputs;
  for (const std::size_t column : columns_) {
    outputs.push_back(static_cast<float*>(state) + column * stride(batch.count));
  }
  run(begin_, batch, nullptr, {}, outputs);
}

void KernelShader::point(const ShadingBatch& batch, const void* state,
                         const host::PointLanes& out) const {
  std::vector<float*> to{out.albedo.x, out.albedo.y, out.albedo.z, out.normal.x,
                         out.normal.y, out.normal.z, out.roughness};
  to.insert(to.end(), out.values.begin(), out.values.end());
  for (std::size_t k = 0; k < point_columns_.size() && k < to.size(); ++k) {
    if (!point_columns_[k]) continue;
    const float* const from =
        static_cast<const float*>(state) + point_columns_[k]->column * stride(batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) {
      to[k][i] = point_columns_[k]->is_whole
                     ? static_cast<float>(std::bit_cast<std::int32_t>(from[i]))
                     : from[i];
    }
  }
}

void KernelShader::sample(const ShadingBatch& batch, const void* state, Lanes3 u,
                          host::SampleLanes out) const {
  // The host's first number chooses the lobe; the kernel's third does.
  const std::array<const void*, 3> extras{u.y, u.z, u.x};
  const std::array<void*, 11> known{out.wi.x,     out.wi.y,     out.wi.z, out.weight.x,
                                    out.weight.y, out.weight.z, out.pdf,  out.lobe,
                                    out.flags,    out.kinds,    out.alpha};
  const std::span<void* const> outputs =
      std::span(known).first(sample_.kernel->program().outputs.size() - sample_parts_.count());
  if (out.parts == nullptr) return run(sample_, batch, state, extras, outputs);
  const std::vector<float> lobes =
      run_by_lobe(sample_, sample_parts_, batch, state, extras, outputs);
  sample_parts_.add(batch, out.wi, out.flags, lobes.data(), stride(batch.count), *out.parts);
}

void KernelShader::evaluate(const ShadingBatch& batch, const void* state, Lanes3 wi,
                            host::EvaluateLanes out) const {
  const std::array<const void*, 3> extras{wi.x, wi.y, wi.z};
  const std::array<void*, 5> known{out.value.x, out.value.y, out.value.z, out.pdf, out.kinds};
  const std::span<void* const> outputs =
      std::span(known).first(evaluate_.kernel->program().outputs.size() - evaluate_parts_.count());
  if (out.parts == nullptr) return run(evaluate_, batch, state, extras, outputs);
  const std::vector<float> lobes =
      run_by_lobe(evaluate_, evaluate_parts_, batch, state, extras, outputs);
  evaluate_parts_.add(batch, wi, nullptr, lobes.data(), stride(batch.count), *out.parts);
}

void KernelShader::emission(const ShadingBatch& batch, Lanes3 radiance) const {
  if (recorder_ != nullptr && begin_.kernel == nullptr) recorder_->add(batch);
  const std::array<void*, 3> outputs{radiance.x, radiance.y, radiance.z};
  run(emission_, batch, nullptr, {}, outputs);
}

void KernelShader::opacity(const ShadingBatch& batch, Lanes3 rgb) const {
  std::vector<float> presence(batch.count);
  const std::array<void*, 4> outputs{presence.data(), rgb.x, rgb.y, rgb.z};
  run(opacity_, batch, nullptr, {}, outputs);
  // What is not let through: presence, but for what the surface itself transmits.
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    for (float* channel : {rgb.x, rgb.y, rgb.z}) channel[i] = presence[i] * (1.0f - channel[i]);
  }
}

void KernelShader::interior(const ShadingBatch& batch, host::InteriorLanes out) const {
  const std::array<void*, 8> all{out.index,        out.absorption.x, out.absorption.y,
                                 out.absorption.z, out.scattering.x, out.scattering.y,
                                 out.scattering.z, out.anisotropy};
  // What is clear has an index only.
  const std::size_t count = interior_.kernel->program().outputs.size();
  for (std::size_t i = count; i < all.size(); ++i)
    std::fill_n(static_cast<float*>(all[i]), batch.count, 0.0f);
  run(interior_, batch, nullptr, {}, {all.data(), count});
}

void KernelShader::volume(const ShadingBatch& batch, host::VolumeLanes out) const {
  const host::InteriorLanes& medium = out.medium;
  const std::array<void*, 10> outputs{medium.absorption.x, medium.absorption.y, medium.absorption.z,
                                      medium.scattering.x, medium.scattering.y, medium.scattering.z,
                                      medium.anisotropy,   out.emission.x,      out.emission.y,
                                      out.emission.z};
  if (volume_.kernel == nullptr) {  // Empty space.
    for (void* const channel : outputs)
      std::fill_n(static_cast<float*>(channel), batch.count, 0.0f);
    return;
  }
  run(volume_, batch, nullptr, {}, outputs);
}

void KernelShader::displacement(const ShadingBatch& batch, Lanes3 offset) const {
  const std::array<void*, 3> outputs{offset.x, offset.y, offset.z};
  run(displacement_, batch, nullptr, {}, outputs);
}

void KernelShader::subsurface(const ShadingBatch& batch, const std::int32_t* lobe,
                              host::SubsurfaceLanes out) const {
  const std::array<const void*, 1> extras{lobe};
  const host::InteriorLanes& medium = out.medium;
  const std::array<void*, 13> outputs{medium.absorption.x, medium.absorption.y, medium.absorption.z,
                                      medium.scattering.x, medium.scattering.y, medium.scattering.z,
                                      medium.anisotropy,   out.albedo.x,        out.albedo.y,
                                      out.albedo.z,        out.normal.x,        out.normal.y,
                                      out.normal.z};
  run(subsurface_, batch, nullptr, extras, outputs);
}

}  // namespace nacre::tool
