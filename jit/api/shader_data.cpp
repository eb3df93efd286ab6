#include "jit/api/shader_data.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string_view>

#include "jit/record/leaves.h"
#include "runtime/channel/channel_name.h"
#include "runtime/channel/channel_table.h"

namespace nacre::api {

namespace {

/// A slot that a kernel reads, or the channel of one that is varying.
struct Use {
  Scalar number = Scalar::f32;
  std::uint32_t value = 0;
  bool is_varying = false;
};

/// The bits of a value's numbers; none for a value of type none.
std::vector<std::uint32_t> bits_of(const Value& value) {
  std::vector<std::uint32_t> bits;
  for (const float number : value.floats) bits.push_back(std::bit_cast<std::uint32_t>(number));
  for (const std::int32_t number : value.ints) bits.push_back(static_cast<std::uint32_t>(number));
  return bits;
}

/// What the document does not have: time, matrices, lobe_mask, whether there is a geomprop.
Parameter parameter_of_slot(std::string_view group, int components, Scalar number) {
  Parameter parameter;
  parameter.path = group;
  parameter.type = components == 16 ? Type::matrix44 : Type::float_;
  if (number == Scalar::i32) parameter.type = Type::integer;
  if (number == Scalar::b1) parameter.type = Type::boolean;
  if (const ChannelGroup* known = find_channel_group(group)) {
    parameter.doc = known->meaning;
    parameter.unit = known->unit;
  }
  return parameter;
}

}  // namespace

ShaderData::ShaderData(std::unique_ptr<MaterialKernels> kernels)
    : point_channels_(std::move(kernels->of_point)),
      state_(std::move(kernels->state)),
      lobes_(std::move(kernels->lobes)),
      facts_(std::move(kernels->facts)),
      has_back_(kernels->has_back) {
  add(NACRE_BEGIN, std::move(kernels->begin));
  add(NACRE_SAMPLE, std::move(kernels->sample));
  add(NACRE_EVALUATE, std::move(kernels->evaluate));
  add(NACRE_EVALUATE_AT, std::move(kernels->evaluate_at));
  add(NACRE_ALBEDO, std::move(kernels->albedo));
  add(NACRE_EMISSION, std::move(kernels->emission));
  add(NACRE_OPACITY, std::move(kernels->opacity));
  add(NACRE_DISPLACEMENT, std::move(kernels->displacement));
  add(NACRE_VOLUME, std::move(kernels->volume));
  add(NACRE_LIGHT, std::move(kernels->light));
  add(NACRE_SHADE, std::move(kernels->shade));
  add(NACRE_INTERIOR, std::move(kernels->interior));
  add(NACRE_SUBSURFACE, std::move(kernels->subsurface));
  add(NACRE_SHADOW, std::move(kernels->shadow));
  add(NACRE_EMIT, std::move(kernels->emit));
  for (const std::string& line : kernels->manifest) {
    const auto& changes = kernels->not_modelled;
    left_out_.emplace_back(line, std::ranges::find(changes, line) != changes.end());
  }
  lay_out(std::move(kernels->parameters));
}

ShaderData::ShaderData(std::unique_ptr<OutputKernel> kernel) : facts_(std::move(kernel->facts)) {
  add(NACRE_OUTPUTS, std::move(kernel->kernel));
  lay_out(std::move(kernel->parameters));
}

const BoundKernel* ShaderData::kernel(nacre_entry entry) const {
  if (entry < 0 || entry >= NACRE_ENTRY_COUNT || !kernels_[entry]) return nullptr;
  return &*kernels_[entry];
}

void ShaderData::add(nacre_entry entry, std::optional<BoundKernel> kernel) {
  if (kernel) kernels_[entry].emplace(std::move(*kernel));
}

void ShaderData::lay_out(std::vector<Parameter> parameters) {
  std::map<std::string, Use, std::less<>> uses;
  const auto is_of_point = [&](const std::optional<BoundKernel>& kernel, const std::string& slot) {
    return &kernel == &kernels_[NACRE_EVALUATE_AT] &&
           std::ranges::find(point_channels_, slot, &Channel::name) != point_channels_.end();
  };
  for (const auto& kernel : kernels_) {
    if (!kernel) continue;
    for (const ParameterSlot& slot : kernel->program().parameters) {
      if (!is_of_point(kernel, slot.name)) uses.insert({slot.name, {slot.type, slot.value, false}});
    }
    for (const Channel& channel : kernel->program().inputs) {
      uses.insert({channel.name, {channel.type, 0, true}});
    }
  }
  std::map<std::string, std::uint32_t, std::less<>> places;
  // Whole parameters, of which kernels may read some components only.
  const auto place = [&](Parameter about, std::vector<std::uint32_t> bits, Scalar number) {
    const int count = static_cast<int>(bits.size());
    ShaderParameter made;
    made.number = number;
    made.components = count;
    made.first = static_cast<std::uint32_t>(block_.size());
    made.minimum = bits_of(about.ui_min);
    made.maximum = bits_of(about.ui_max);
    bool is_used = false;
    for (int i = 0; i < count; ++i) {
      const std::string slot = slot_name(about.path, i, count);
      const auto use = uses.find(slot);
      if (use == uses.end()) continue;
      is_used = true;
      made.is_varying = made.is_varying || use->second.is_varying;
      places[slot] = made.first + static_cast<std::uint32_t>(i);
      uses.erase(use);
    }
    if (!is_used) return;
    block_.insert(block_.end(), bits.begin(), bits.end());
    made.about = std::move(about);
    parameters_.push_back(std::move(made));
  };
  for (Parameter& parameter : parameters) {
    std::vector<std::uint32_t> bits = bits_of(parameter.value);
    const Scalar number = scalar_of(parameter.type);
    place(std::move(parameter), std::move(bits), number);
  }
  for (const char* matrix : {"object_to_world", "world_to_object"}) {
    std::vector<std::uint32_t> identity(16, 0);
    for (std::size_t i = 0; i < 16; i += 5) identity[i] = std::bit_cast<std::uint32_t>(1.0f);
    place(parameter_of_slot(matrix, 16, Scalar::f32), std::move(identity), Scalar::f32);
  }
  // What is left is slots of one number, and the channels of points.
  const auto left = uses;
  for (const auto& [name, use] : left) {
    const ChannelGroup* known = find_channel_group(parse_channel(name).group);
    const bool is_channel =
        use.is_varying && (known == nullptr || known->role != ChannelRole::slot);
    if (!is_channel) place(parameter_of_slot(name, 1, use.number), {use.value}, use.number);
  }
  for (std::size_t entry = 0; entry < kernels_.size(); ++entry) {
    if (!kernels_[entry]) continue;
    for (const ParameterSlot& slot : kernels_[entry]->program().parameters) {
      slots_[entry].push_back(is_of_point(kernels_[entry], slot.name) ? of_point
                                                                      : places.at(slot.name));
    }
  }
}

}  // namespace nacre::api
