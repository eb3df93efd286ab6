#include "jit/llvm/run_code.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "jit/llvm/run_state.h"
#include "runtime/float_environment.h"

namespace nacre {

namespace {

/// Runs code on parts of a batch.
class CodeRun {
 public:
  /// `rows`: room for a pointer a channel.
  CodeRun(LoadedCode::Entry entry, const Program& program, const StepLimit& limit,
          const KernelArguments& arguments, void** rows)
      : entry_(entry),
        inputs_(program.inputs.size()),
        outputs_(program.outputs.size()),
        arguments_(arguments),
        rows_(rows),
        state_(first_state(arguments, limit.max_steps())) {}

  /// Points [first, first + count): whole passes.
  RunStatus points(std::uint64_t first, std::uint64_t count) {
    if (first == 0) return call(arguments_.inputs, arguments_.outputs, count);
    for (std::size_t k = 0; k < inputs_; ++k) rows_[k] = const_cast<std::byte*>(input(k, first));
    for (std::size_t k = 0; k < outputs_; ++k) rows_[inputs_ + k] = output(k, first);
    return call(rows_, rows_ + inputs_, count);
  }

  /// The points from `first` on, fewer than a pass, by way of copies: `words` has room for
  /// `lanes` words a channel. The last point is repeated, so that the lanes which nobody
  /// asked for take no other way than one that somebody did.
  RunStatus tail(std::uint64_t first, std::size_t lanes, std::uint32_t* words) {
    const auto count = static_cast<std::size_t>(arguments_.count - first);
    for (std::size_t k = 0; k < inputs_ + outputs_; ++k) rows_[k] = words + k * lanes;
    for (std::size_t k = 0; k < inputs_; ++k) {
      std::uint32_t* to = words + k * lanes;
      std::memcpy(to, input(k, first), 4 * count);
      std::fill(to + count, to + lanes, to[count - 1]);
    }
    const RunStatus status = call(rows_, rows_ + inputs_, lanes);
    for (std::size_t k = 0; k < outputs_; ++k) {
      std::memcpy(output(k, first), words + (inputs_ + k) * lanes, 4 * count);
    }
    return status;
  }

 private:
  const std::byte* input(std::size_t k, std::uint64_t first) const {
    return static_cast<const std::byte*>(arguments_.inputs[k]) + 4 * first;
  }
  std::byte* output(std::size_t k, std::uint64_t first) const {
    return static_cast<std::byte*>(arguments_.outputs[k]) + 4 * first;
  }

  RunStatus call(const void* const* inputs, void* const* outputs, std::uint64_t count) {
    state_.arguments.inputs = inputs;
    state_.arguments.outputs = outputs;
    state_.arguments.count = count;
    entry_(&state_);
    if (state_.steps_left < 0) return RunStatus::too_many_steps;
    const bool stops = state_.arguments.stop->load(std::memory_order_relaxed) != 0;
    return stops ? RunStatus::stopped : RunStatus::done;
  }

  LoadedCode::Entry entry_;
  std::size_t inputs_;
  std::size_t outputs_;
  const KernelArguments& arguments_;
  void** rows_;
  RunState state_;
};

RunStatus run_all(CodeRun& run, std::size_t lanes, const StepLimit& limit,
                  const KernelArguments& arguments, std::uint32_t* words) {
  const std::uint64_t whole = arguments.count - arguments.count % lanes;
  // Without anybody who may ask to stop there is nothing to look for.
  const std::uint64_t stride =
      arguments.stop != nullptr ? limit.passes_between_looks() * lanes : whole;
  for (std::uint64_t first = 0; first < whole; first += stride) {
    const RunStatus status = run.points(first, std::min(stride, whole - first));
    if (status != RunStatus::done) return status;
  }
  return whole == arguments.count ? RunStatus::done : run.tail(whole, lanes, words);
}

}  // namespace

RunStatus run_code(LoadedCode::Entry entry, const Program& program, int lanes,
                   const StepLimit& limit, const KernelArguments& arguments) {
  const ScopedFloatEnvironment environment;
  const auto width = static_cast<std::size_t>(lanes);

  // Enough for 256 channels of 16 lanes; what needs more pays for memory.
  constexpr std::size_t usual = 256;
  const std::size_t channels = program.inputs.size() + program.outputs.size();
  if (channels <= usual) {
    std::array<std::uint32_t, usual * 16> words;
    std::array<void*, usual> rows;
    CodeRun run(entry, program, limit, arguments, rows.data());
    return run_all(run, width, limit, arguments, words.data());
  }
  const auto words = std::make_unique_for_overwrite<std::uint32_t[]>(channels * width);
  const auto rows = std::make_unique_for_overwrite<void*[]>(channels);
  CodeRun run(entry, program, limit, arguments, rows.get());
  return run_all(run, width, limit, arguments, words.get());
}

}  // namespace nacre
