#include "jit/passes/tabulate/sampler.h"

#include <string>

#include "runtime/program/slice.h"

namespace nacre {

Sampler::Sampler(const Program& program, const Cone& cone, ValueId key,
                 const std::vector<ValueId>& values)
    : count_(values.size()) {
  Recorder recorder;
  recorder.adopt_interface(program);
  const auto again = record_again(recorder, program.entry(), cone, key,
                                  recorder.input("tabulated number", Scalar::f32));
  std::vector<SliceOutput> wanted;
  for (std::size_t k = 0; k < count_; ++k) {
    wanted.push_back({std::to_string(k), again.at(values[k])});
  }
  kernel_ = make_reference(slice(recorder.program(), "tabulated", wanted));
}

std::vector<std::vector<double>> Sampler::run(std::span<const float> numbers) const {
  std::vector<std::vector<double>> found(count_, std::vector<double>(numbers.size()));
  std::vector<void*> columns;
  for (std::vector<double>& column : found) columns.push_back(column.data());
  const void* const input = numbers.data();
  KernelArguments arguments;
  arguments.inputs = &input;
  arguments.outputs = columns.data();
  arguments.count = numbers.size();
  if (kernel_->run_double(arguments) != RunStatus::done) found.clear();
  return found;
}

}  // namespace nacre
