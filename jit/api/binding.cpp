// Where a host has its numbers, and running kernels on them.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <span>

#include "jit/api/call.h"
#include "jit/api/handles.h"
#include "jit/api/run_status.h"
#include "runtime/batch/words.h"

using namespace nacre;
using namespace nacre::api;

struct nacre_binding {
  std::shared_ptr<const ShaderData> data;
  std::array<std::optional<Binding>, NACRE_ENTRY_COUNT> entries;
  /// Each kernel's slots with the values of the document, for calls without an instance.
  std::array<std::vector<std::uint32_t>, NACRE_ENTRY_COUNT> slots;
  /// What goes with them, filled in by calls.
  FittedByEntry fitted;
  /// Of NACRE_EVALUATE_AT: where ShaderData::point_channels() are, as inputs.
  std::optional<Binding> of_point;
  std::vector<std::uint32_t> point_slots;  ///< Of the kernel, one each of its inputs.
};

namespace {

constexpr std::array elements{ElementOf::point, ElementOf::place, ElementOf::instance};

/// A kernel's slots out of a block of values, as ShaderData::block.
void take_slots(const nacre_binding& binding, nacre_entry entry,
                const std::vector<std::uint32_t>& values, std::uint32_t* to) {
  const std::vector<std::uint32_t>& places = binding.data->slots(entry);
  if (entry == NACRE_EVALUATE_AT) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      to[i] = places[i] != ShaderData::of_point ? values[places[i]] : 0;
    }
  } else {
    gather_words(places.size(), to, [&](std::size_t i) { return &values[places[i]]; });
  }
  for (const std::uint32_t slot : binding.entries[entry]->present) to[slot] = 1;
}

/// Slots of one call.
class Slots {
 public:
  explicit Slots(std::size_t count) : count_(count) {
    if (count > few_.size()) many_ = std::make_unique_for_overwrite<std::uint32_t[]>(count);
  }
  std::uint32_t* data() { return many_ != nullptr ? many_.get() : few_.data(); }
  std::span<const std::uint32_t> get() { return {data(), count_}; }

 private:
  std::size_t count_;
  std::array<std::uint32_t, 256> few_;
  std::unique_ptr<std::uint32_t[]> many_;
};

/// The channels of NACRE_EVALUATE_AT's one point that the kernel has slots for, as if another
/// kernel read them. False, with errors, where one has no place.
bool bind_point(const Binder& binder, nacre_binding& binding, Diagnostics& said) {
  const auto& slots = binding.data->kernel(NACRE_EVALUATE_AT)->program().parameters;
  Program reader;
  for (const Channel& channel : binding.data->point_channels()) {
    const auto slot = std::ranges::find(slots, channel.name, &ParameterSlot::name);
    if (slot == slots.end()) continue;
    binding.point_slots.push_back(static_cast<std::uint32_t>(slot - slots.begin()));
    reader.inputs.push_back(channel);
  }
  binding.of_point = binder.finish(reader, binding.data->state(), said);
  return binding.of_point.has_value();
}

/// Fills in the slots of the one point; false where the batch lacks an array or the point's
/// instance.
bool take_point(const nacre_binding& binding, const Batch& batch, std::uint32_t point,
                std::uint32_t* slots) {
  const Binding& of_point = *binding.of_point;
  if (batch.arrays.size() < of_point.arrays) return false;
  for (std::size_t i = 0; i < of_point.inputs.size(); ++i) {
    const ChannelLayout& layout = of_point.inputs[i];
    const bool is_of_instance = layout.element == ElementOf::instance;
    if (is_of_instance && batch.instances == nullptr) return false;
    const std::uint32_t element = is_of_instance ? batch.instances[point] : point;
    const auto* array = static_cast<const std::byte*>(
        layout.array == bound_constants ? of_point.constants.data() : batch.arrays[layout.array]);
    std::memcpy(slots + binding.point_slots[i],
                array + layout.offset + layout.stride * std::ptrdiff_t{element}, sizeof *slots);
  }
  return true;
}

}  // namespace

nacre_status nacre_binder_create(nacre_binder** binder) {
  if (binder == nullptr) return NACRE_WRONG_ARGUMENTS;
  *binder = new (std::nothrow) nacre_binder;
  return *binder != nullptr ? NACRE_OK : NACRE_OUT_OF_MEMORY;
}

void nacre_binder_destroy(nacre_binder* binder) { delete binder; }

nacre_status nacre_binder_array(nacre_binder* binder, const char* name,
                                const nacre_layout* layout) {
  if (binder == nullptr || name == nullptr || layout == nullptr || !has_size(layout)) {
    return NACRE_WRONG_ARGUMENTS;
  }
  const nacre_layout asked = options_of(layout);
  const bool is_known = asked.element >= 0 && asked.element < static_cast<int>(elements.size());
  if (!is_known || asked.array >= bound_constants) return NACRE_WRONG_ARGUMENTS;
  return guarded([&] {
    binder->binder.bind(name,
                        {.array = asked.array,
                         .offset = asked.offset,
                         .stride = asked.stride,
                         .element = elements[static_cast<std::size_t>(asked.element)]},
                        asked.component_stride);
    return NACRE_OK;
  });
}

nacre_status nacre_binder_constant(nacre_binder* binder, const char* name, const void* values,
                                   size_t count) {
  if (binder == nullptr || name == nullptr || values == nullptr) return NACRE_WRONG_ARGUMENTS;
  return guarded([&] {
    std::vector<std::uint32_t> bits(count);
    std::memcpy(bits.data(), values, 4 * count);
    binder->binder.bind_constant(name, bits);
    return NACRE_OK;
  });
}

nacre_status nacre_binding_create(const nacre_binder* binder, const nacre_shader* shader,
                                  uint32_t entries, nacre_report* report, nacre_binding** binding) {
  if (binding == nullptr) return NACRE_WRONG_ARGUMENTS;
  *binding = nullptr;
  if (binder == nullptr || shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    Said said(report);
    auto made = std::make_unique<nacre_binding>();
    made->data = shader->data;
    made->fitted = fitted_of(*shader->data);
    bool is_complete = true;
    for (int i = 0; i < NACRE_ENTRY_COUNT; ++i) {
      const auto entry = static_cast<nacre_entry>(i);
      const BoundKernel* kernel = shader->data->kernel(entry);
      const bool is_wanted = entries == 0 || (entries >> i & 1) != 0;
      if (kernel == nullptr || !is_wanted) continue;
      made->entries[entry] =
          binder->binder.finish(kernel->program(), shader->data->state(), said.diagnostics());
      is_complete = is_complete && made->entries[entry].has_value();
      if (made->entries[entry]) {
        made->slots[entry].resize(shader->data->slots(entry).size());
        take_slots(*made, entry, shader->data->block(), made->slots[entry].data());
      }
      if (entry != NACRE_EVALUATE_AT) continue;
      is_complete = bind_point(binder->binder, *made, said.diagnostics()) && is_complete;
    }
    if (!is_complete) return NACRE_FAILED;
    *binding = made.release();
    return NACRE_OK;
  });
}

void nacre_binding_destroy(nacre_binding* binding) { delete binding; }

nacre_status nacre_run(const nacre_binding* binding, nacre_entry entry,
                       const nacre_instance* instance, const nacre_batch* given) {
  if (binding == nullptr || given == nullptr || !has_size(given)) return NACRE_WRONG_ARGUMENTS;
  if (entry < 0 || entry >= NACRE_ENTRY_COUNT) return NACRE_WRONG_ARGUMENTS;
  const BoundKernel* kernel = binding->data->kernel(entry);
  if (kernel == nullptr) return NACRE_OK;
  if (!binding->entries[entry]) return NACRE_WRONG_ARGUMENTS;
  if (instance != nullptr && instance->data != binding->data) return NACRE_WRONG_ARGUMENTS;
  return guarded([&] {
    const nacre_batch asked = options_of(given);
    static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t) &&
                  std::atomic<std::uint32_t>::is_always_lock_free);
    const Batch batch{.arrays = {asked.arrays, asked.array_count},
                      .count = asked.count,
                      .points = asked.points,
                      .instances = asked.instances,
                      .stop = reinterpret_cast<const std::atomic<std::uint32_t>*>(
                          const_cast<const std::uint32_t*>(asked.stop))};
    const Binding& bound = *binding->entries[entry];
    if (instance == nullptr && entry != NACRE_EVALUATE_AT) {
      return status_of(
          kernel->run(bound, batch, binding->slots[entry], last_of(binding->fitted, entry)));
    }
    Slots slots(binding->slots[entry].size());
    take_slots(*binding, entry, instance != nullptr ? instance->block : binding->data->block(),
               slots.data());
    if (entry == NACRE_EVALUATE_AT && !take_point(*binding, batch, asked.point, slots.data())) {
      return nacre_status{NACRE_WRONG_ARGUMENTS};
    }
    LastFitted* const last =
        last_of(instance != nullptr ? instance->fitted : binding->fitted, entry);
    return status_of(kernel->run(bound, batch, slots.get(), last));
  });
}
