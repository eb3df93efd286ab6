#include "jit/compile/fact_kernel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

#include "jit/compile/facts.h"
#include "runtime/batch/room.h"

namespace nacre {

namespace {

/// Points that are checked together: enough for what is computed once a call not to count, few
/// enough for what they are to stay in a level-1 cache.
constexpr std::size_t block = 2048;
/// Points that are computed again where one of them is outside: as wide as code is.
constexpr std::size_t group = 16;
/// Channels that need no memory from the heap.
constexpr std::size_t usual_channels = 96;

Program without_check(Program program) {
  assert(program.outputs.back().name == outside_facts_channel);
  auto& code = program.entry().code;
  // Of code that was in the cache there may be the Program as it was before the check.
  const auto number = static_cast<std::uint32_t>(program.outputs.size() - 1);
  std::erase_if(code, [&](const Instruction& x) { return x.op == Op::store && x.imm == number; });
  program.outputs.pop_back();
  return program;
}

/// A call's points, block by block.
class Blocks {
 public:
  /// Who computes so many points that facts are not true of.
  using GeneralFor = std::function<const Kernel&(std::size_t count)>;

  Blocks(const Program& program, const KernelArguments& arguments)
      : arguments_(arguments),
        inputs_(program.inputs.size()),
        channels_(inputs_ + program.outputs.size()),
        arrays_(channels_ + 1) {}

  RunStatus run(const Kernel& narrow, const GeneralFor& general) {
    for (std::uint64_t first = 0; first < arguments_.count; first += block) {
      const auto count =
          static_cast<std::size_t>(std::min<std::uint64_t>(block, arguments_.count - first));
      RunStatus status = run_part(narrow, first, count);
      if (status == RunStatus::too_many_steps) {
        // Of numbers that were not foreseen a loop may take longer than it would.
        status = run_part(general(count), first, count);
      } else if (status == RunStatus::done) {
        status = run_outside(general, first, count);
      }
      if (status != RunStatus::done) return status;
    }
    return RunStatus::done;
  }

 private:
  /// Groups of which a point is outside, as many as stand side by side at once.
  RunStatus run_outside(const GeneralFor& general, std::uint64_t first, std::size_t count) {
    const std::size_t whole = whole_groups(count);
    std::fill(outside_.begin() + count, outside_.begin() + whole, 0);
    RunStatus status = RunStatus::done;
    if (!any_outside(whole)) return status;
    for (std::size_t at = 0; at < count && status == RunStatus::done;) {
      std::size_t end = at;
      while (end < count && group_at(end) != 0) end += group;
      if (end == at) {
        at += group;
        continue;
      }
      end = std::min(end, count);
      status = run_part(general(end - at), first + at, end - at);
      at = end;
    }
    return status;
  }

  static std::size_t whole_groups(std::size_t count) { return (count + group - 1) / group * group; }

  bool any_outside(std::size_t whole) const {
    std::uint32_t any = 0;
    for (std::size_t at = 0; at < whole; at += group) any |= group_at(at);
    return any != 0;
  }

  /// Not 0 where one of the group is outside.
  std::uint32_t group_at(std::size_t at) const {
    std::uint32_t any = 0;
    for (std::size_t k = 0; k < group; ++k) any |= outside_[at + k];  // Whole vectors.
    return any;
  }

  RunStatus run_part(const Kernel& kernel, std::uint64_t first, std::size_t count) {
    void** const arrays = arrays_.data();
    const auto place = [first](const void* array) {
      return static_cast<std::byte*>(const_cast<void*>(array)) + 4 * first;
    };
    for (std::size_t k = 0; k < inputs_; ++k) arrays[k] = place(arguments_.inputs[k]);
    for (std::size_t k = inputs_; k < channels_; ++k) {
      arrays[k] = place(arguments_.outputs[k - inputs_]);
    }
    arrays[channels_] = outside_.data();  // Which a general kernel does not know.
    KernelArguments some = arguments_;
    some.inputs = arrays;
    some.outputs = arrays + inputs_;
    some.count = count;
    return kernel.run(some);
  }

  const KernelArguments& arguments_;
  const std::size_t inputs_, channels_;
  Room<void*, usual_channels> arrays_;
  std::array<std::uint32_t, block> outside_;
};

}  // namespace

class FactKernel::General {
 public:
  explicit General(MakeGeneral make) : make_(std::move(make)) {}

  const std::shared_ptr<const Kernel>& kernel() {
    std::call_once(once_, [this] {
      kernel_ = make_();
      make_ = nullptr;
      is_made_ = true;
    });
    return kernel_;
  }
  /// Null where nobody has needed it yet.
  const Kernel* kernel_if_made() const { return is_made_ ? kernel_.get() : nullptr; }

  std::atomic<std::uint64_t> points = 0;

 private:
  std::once_flag once_;
  MakeGeneral make_;
  std::shared_ptr<const Kernel> kernel_;
  std::atomic<bool> is_made_ = false;
};

FactKernel::FactKernel(std::shared_ptr<const Kernel> narrow, MakeGeneral general)
    : narrow_(std::move(narrow)),
      program_(without_check(narrow_->program())),
      general_(std::make_unique<General>(std::move(general))) {}

FactKernel::~FactKernel() = default;

RunStatus FactKernel::run(const KernelArguments& arguments) const {
  return Blocks(program_, arguments).run(*narrow_, [this](std::size_t count) -> const Kernel& {
    general_->points.fetch_add(count, std::memory_order_relaxed);
    return *general_->kernel();
  });
}

const Program& FactKernel::program() const { return program_; }

CompiledKernel* FactKernel::compiled() const {
  // What it computes stays the same, whoever cancels or waits.
  return dynamic_cast<CompiledKernel*>(const_cast<Kernel*>(narrow_.get()));
}

// The general kernel has the same: facts leave out what comes behind them.
Fits FactKernel::fits() const {
  if (compiled() != nullptr) return compiled()->fits();
  return {narrow_->program().fits, narrow_->program().fitted_rows};
}

CompiledKernel::State FactKernel::state() const {
  return compiled() != nullptr ? compiled()->state() : State::ready;
}

std::optional<CompiledKernel::Code> FactKernel::code(bool single) const {
  auto* made = dynamic_cast<const CompiledKernel*>(general_->kernel().get());
  if (made == nullptr || !made->wait()) return std::nullopt;
  return made->code(single);
}

bool FactKernel::wait() const { return compiled() == nullptr || compiled()->wait(); }

void FactKernel::cancel() {
  if (compiled() != nullptr) compiled()->cancel();
}

void FactKernel::when_ended(std::function<void()> call) {
  if (compiled() == nullptr) return call();
  compiled()->when_ended(std::move(call));
}

CompileStats FactKernel::stats() const {
  return compiled() != nullptr ? compiled()->stats() : CompileStats{};
}

Diagnostics FactKernel::diagnostics() const {
  Diagnostics all = compiled() != nullptr ? compiled()->diagnostics() : Diagnostics{};
  const auto* general = dynamic_cast<const CompiledKernel*>(general_->kernel_if_made());
  if (general == nullptr) return all;
  const Diagnostics more = general->diagnostics();
  for (const Diagnostic& one : more.all()) all.add(one);
  return all;
}

std::uint64_t FactKernel::points_outside() const { return general_->points; }

}  // namespace nacre
