#include "tests/support/run_kernel.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace nacre {

namespace {

/// Input arrays in the order of a Program, each `count` long: the columns themselves, which outlive
/// this, where they are so long and hold floats.
struct Inputs {
  Inputs(const Program& program, const Columns& columns) {
    for (const auto& [name, column] : columns) count = std::max(count, column.size());
    arrays.reserve(program.inputs.size());
    for (const Channel& channel : program.inputs) {
      const auto found = columns.find(channel.name);
      if (found != columns.end() && found->second.size() == count && channel.type == Scalar::f32) {
        pointers.push_back(found->second.data());
        continue;
      }
      std::vector<float>& array = arrays.emplace_back();
      if (found == columns.end() || found->second.size() == 1) {
        array.assign(count, found == columns.end() ? 0.0f : found->second.front());
      } else {
        array = found->second;
      }
      if (channel.type != Scalar::f32) {
        for (float& x : array) x = std::bit_cast<float>(static_cast<std::int32_t>(x));
      }
      pointers.push_back(array.data());
    }
    for (const ParameterSlot& slot : program.parameters) slots.push_back(slot.value);
  }

  KernelArguments arguments(void* const* outputs) const {
    return {
        .inputs = pointers.data(), .outputs = outputs, .parameters = slots.data(), .count = count};
  }

  std::size_t count = 1;
  std::vector<std::vector<float>> arrays;
  std::vector<const void*> pointers;
  std::vector<std::uint32_t> slots;
};

/// The outputs of a Program as arrays of T; integers take four bytes each.
template <class T, class F>
std::map<std::string, std::vector<T>> collect(const Program& program, std::size_t count, F&& run) {
  std::vector<std::vector<T>> arrays(program.outputs.size(), std::vector<T>(count));
  std::vector<void*> pointers;
  for (auto& array : arrays) pointers.push_back(array.data());
  run(pointers.data());
  std::map<std::string, std::vector<T>> out;
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    if (program.outputs[k].type != Scalar::f32) {
      std::vector<std::int32_t> integers(count);
      std::memcpy(integers.data(), arrays[k].data(), count * sizeof(std::int32_t));
      std::ranges::copy(integers, arrays[k].begin());
    }
    out[program.outputs[k].name] = std::move(arrays[k]);
  }
  return out;
}

}  // namespace

Columns run(const Kernel& kernel, const Columns& columns) {
  const Inputs inputs(kernel.program(), columns);
  return collect<float>(kernel.program(), inputs.count,
                        [&](void** outputs) { kernel.run(inputs.arguments(outputs)); });
}

DoubleColumns run_double(const ReferenceKernel& kernel, const Columns& columns) {
  const Inputs inputs(kernel.program(), columns);
  return collect<double>(kernel.program(), inputs.count,
                         [&](void** outputs) { kernel.run_double(inputs.arguments(outputs)); });
}

}  // namespace nacre
