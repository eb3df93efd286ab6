#include "jit/passes/tabulate/sampler.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "jit/passes/tabulate/plan.h"
#include "runtime/program/slice.h"

namespace nacre {

namespace {

Ref number_of(Recorder& recorder) { return recorder.input("tabulated number", Scalar::f32); }

Program values_of(Recorder& recorder, const Refs& again, const std::vector<ValueId>& values) {
  std::vector<SliceOutput> wanted;
  for (std::size_t k = 0; k < values.size(); ++k) {
    wanted.push_back({std::to_string(k), again.at(values[k])});
  }
  Program program = slice(recorder.program(), "tabulated", wanted);
  // Which it reads none of.
  program.fits.clear();
  program.fitted_rows = 0;
  return program;
}

}  // namespace

Program program_of(const Program& program, const Cone& cone, ValueId key,
                   const std::vector<ValueId>& values) {
  Recorder recorder;
  recorder.adopt_interface(program);
  return values_of(recorder,
                   record_again(recorder, program.entry(), cone, key, number_of(recorder)), values);
}

Sampler::Sampler(const Program& program, const Cone& cone, ValueId key,
                 const std::vector<ValueId>& values)
    : count_(values.size()) {
  make(program_of(program, cone, key, values));
}

Sampler::Sampler(const Program& program, const Groups& groups, const Cone& cone, ValueId key,
                 const std::vector<ValueId>& values, const std::vector<Looked>& plan)
    : count_(values.size()) {
  Recorder recorder;
  recorder.adopt_interface(program);
  const auto looked_up = [&](ValueId value, const Refs& before) -> std::optional<Ref> {
    for (const Looked& looked : plan) {
      const auto found = std::ranges::find(looked.values, value);
      if (found == looked.values.end()) continue;
      const auto function = static_cast<std::size_t>(found - looked.values.begin());
      return record_looked(recorder, program, groups, looked, function, before.at(looked.key));
    }
    return std::nullopt;
  };
  const Refs again =
      record_again(recorder, program.entry(), cone, key, number_of(recorder), looked_up);
  make(values_of(recorder, again, values));
}

void Sampler::make(Program program) { kernel_ = make_reference(std::move(program)); }

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
