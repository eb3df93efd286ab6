#include "runtime/interpreter/interpreter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "runtime/float_environment.h"
#include "runtime/interpreter/block.h"
#include "runtime/interpreter/prepared.h"
#include "runtime/program/fold.h"

namespace nacre {

namespace {

bool any(const Register& mask) {
  return std::any_of(mask.begin(), mask.end(), [](std::uint32_t lane) { return lane != 0; });
}

/// The state of one run() on one thread.
class Run {
 public:
  Run(const Program& program, std::span<const std::vector<std::uint32_t>> tables,
      const std::vector<Prepared>& functions, const StepLimit& limit, const KernelArguments& args)
      : functions_(functions), limit_(limit), block_{program, tables, args} {}

  RunStatus all_blocks() {
    const Prepared& entry = functions_.front();
    frames_.resize(entry.registers.count);
    Activation frame{.base = 0, .prepared = &entry};
    load_constants(frame);
    steps_left_ = static_cast<double>(limit_.max_steps());
    execute(frame, Turn::once);
    const KernelArguments& args = block_.arguments;
    for (; block_.first < args.count && steps_left_ >= 0; block_.first += block_lanes) {
      block_.lanes =
          static_cast<int>(std::min<std::uint64_t>(block_lanes, args.count - block_.first));
      steps_left_ = static_cast<double>(limit_.max_steps());
      execute(frame, Turn::each);
      if (is_asked_to_stop() && steps_left_ >= 0) return RunStatus::stopped;
    }
    return steps_left_ < 0 ? RunStatus::too_many_steps : RunStatus::done;
  }

 private:
  /// A function being executed: its registers are frames_[base ...].
  struct Activation {
    std::size_t base;
    const Prepared* prepared;
    std::span<const ValueId> arguments{};  ///< The caller's values.
    const Activation* caller = nullptr;
  };
  struct LoopState {
    std::size_t start;
    std::uint32_t iteration = 0;
    Register active;
  };

  bool is_asked_to_stop() const {
    return block_.arguments.stop != nullptr &&
           block_.arguments.stop->load(std::memory_order_relaxed) != 0;
  }

  Register& reg(const Activation& frame, ValueId id) {
    return frames_[frame.base + frame.prepared->registers.of[id]];
  }

  void load_constants(const Activation& frame) {
    const Function& function = *frame.prepared->function;
    for (std::size_t i = 0; i < function.code.size(); ++i) {
      if (function.code[i].op != Op::constant) continue;
      block_.load_constant(reg(frame, static_cast<ValueId>(i)), function.code[i]);
    }
  }

  /// What has its turn.
  void execute(const Activation& frame, Turn turn) {
    const Function& function = *frame.prepared->function;
    const std::vector<Step>& steps = frame.prepared->steps;
    std::vector<LoopState> loops;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Step& step = steps[i];
      if (step.turn != turn) continue;
      if (step.run != nullptr) {
        Register* registers = frames_.data() + frame.base;
        const auto at = [&](std::size_t k) { return registers[step.registers[k]].data(); };
        step.run(at(0), at(1), at(2), at(3));
        continue;
      }
      const Instruction& instruction = function.code[i];
      const auto id = static_cast<ValueId>(i);
      switch (instruction.op) {
        case Op::if_any: i = open_if(frame, i); break;
        case Op::merge:
          blend(frame, id, reg(frame, frame.prepared->mask[i]), instruction.operands[0],
                instruction.operands[1]);
          break;
        case Op::loop: i = open_loop(frame, i, loops); break;
        case Op::next:
          blend(frame, id, loops.back().active, instruction.operands[1], instruction.operands[0]);
          break;
        case Op::again: {
          const Register& condition = reg(frame, instruction.operands[0]);
          for (int k = 0; k < block_lanes; ++k) loops.back().active[k] &= condition[k];
          break;
        }
        case Op::end_loop: i = close_loop(frame, i, loops); break;
        case Op::end_if:
        case Op::carry: break;
        default: compute(frame, id, instruction); break;
      }
    }
  }

  void blend(const Activation& frame, ValueId to, const Register& mask, ValueId yes, ValueId no) {
    const Register& a = reg(frame, yes);
    const Register& b = reg(frame, no);
    Register& result = reg(frame, to);
    for (int k = 0; k < block_lanes; ++k) result[k] = mask[k] != 0 ? a[k] : b[k];
  }

  /// Enters the region, or gives its merges their outer values and skips it.
  std::size_t open_if(const Activation& frame, std::size_t i) {
    const Function& function = *frame.prepared->function;
    if (any(reg(frame, function.code[i].operands[0]))) return i;
    const std::vector<ValueId>& next = frame.prepared->next_merge;
    for (ValueId merge = next[i]; merge != no_value; merge = next[merge]) {
      reg(frame, merge) = reg(frame, function.code[merge].operands[1]);
    }
    return frame.prepared->end[i];
  }

  std::size_t open_loop(const Activation& frame, std::size_t i, std::vector<LoopState>& loops) {
    const Function& function = *frame.prepared->function;
    const std::size_t end = frame.prepared->end[i];
    LoopState state{.start = i, .active = reg(frame, function.code[i].operands[0])};
    for_each_next(frame, i, [&](ValueId next, ValueId carry) {
      const ValueId initial = function.code[carry].operands[0];
      reg(frame, carry) = reg(frame, initial);
      reg(frame, next) = reg(frame, initial);
    });
    // A carry without a next was never assigned: it stays what it was. Literals
    // may stand between carries.
    for (std::size_t k = i + 1; k < end && !opens_region(function.code[k].op); ++k) {
      const Instruction& carry = function.code[k];
      if (carry.op != Op::carry) continue;
      reg(frame, static_cast<ValueId>(k)) = reg(frame, carry.operands[0]);
    }
    if (!any(state.active)) return end;
    loops.push_back(state);
    return i;
  }

  std::size_t close_loop(const Activation& frame, std::size_t i, std::vector<LoopState>& loops) {
    const Function& function = *frame.prepared->function;
    LoopState& state = loops.back();
    const std::uint32_t imm = function.code[state.start].imm;
    const bool wants_more = any(state.active);
    const bool may_more = ++state.iteration < loop_bound(imm);
    if (wants_more && !may_more && (imm & loop_must_end) != 0) steps_left_ = -1;
    if (wants_more && may_more && pays_for_round(frame, state.start)) {
      for_each_next(frame, state.start,
                    [&](ValueId next, ValueId carry) { reg(frame, carry) = reg(frame, next); });
      return state.start;
    }
    loops.pop_back();
    return i;
  }

  /// False once there were too many steps, or somebody asks to stop: then the loops around
  /// end too, at their next round, and the block comes to its end.
  bool pays_for_round(const Activation& frame, std::size_t opening) {
    if (!limit_.is_counted()) return true;
    steps_left_ -= frame.prepared->round[opening];
    return steps_left_ >= 0 && !is_asked_to_stop();
  }

  template <class F>
  void for_each_next(const Activation& frame, std::size_t opening, F&& f) {
    const Function& function = *frame.prepared->function;
    int depth = 0;
    for (std::size_t k = opening + 1; k < frame.prepared->end[opening]; ++k) {
      const Instruction& inner = function.code[k];
      if (opens_region(inner.op)) ++depth;
      if (closes_region(inner.op)) --depth;
      if (depth == 0 && inner.op == Op::next) f(static_cast<ValueId>(k), inner.operands[0]);
    }
  }

  /// What is no lane operation.
  void compute(const Activation& frame, ValueId id, const Instruction& instruction) {
    switch (instruction.op) {
      case Op::parameter: block_.load_parameter(reg(frame, id), instruction); break;
      case Op::input: block_.load_input(reg(frame, id), instruction); break;
      case Op::argument:
        reg(frame, id) = reg(*frame.caller, frame.arguments[instruction.imm]);
        break;
      case Op::table:
        block_.load_table(reg(frame, id), instruction, reg(frame, instruction.operands[0]));
        break;
      case Op::fitted:
        block_.load_fitted(reg(frame, id), instruction, reg(frame, instruction.operands[0]));
        break;
      case Op::texel:
        block_.load_texel(reg(frame, id), reg(frame, instruction.operands[0]),
                          reg(frame, instruction.operands[1]));
        break;
      case Op::call: call(frame, instruction); break;
      case Op::texture_call: texture_call(frame, instruction); break;
      case Op::result: reg(frame, id) = results_[instruction.imm]; break;
      case Op::give:
        results_pending_.resize(frame.prepared->function->results.size());
        results_pending_[instruction.imm] = reg(frame, instruction.operands[0]);
        break;
      case Op::store: block_.store(reg(frame, instruction.operands[0]), instruction); break;
      default: assert(false && "an operation that the passes should have expanded");
    }
  }

  void call(const Activation& frame, const Instruction& instruction) {
    const Prepared& callee = functions_[instruction.imm];
    const std::size_t base = frame.base + frame.prepared->registers.count;
    if (frames_.size() < base + callee.registers.count) {
      frames_.resize(base + callee.registers.count);
    }
    const Activation inner{.base = base,
                           .prepared = &callee,
                           .arguments = frame.prepared->function->operands(instruction),
                           .caller = &frame};
    load_constants(inner);
    execute(inner, Turn::each);
    std::swap(results_, results_pending_);
  }

  void texture_call(const Activation& frame, const Instruction& instruction) {
    const auto operands = frame.prepared->function->operands(instruction);
    std::array<const Register*, 8> from{};
    for (std::size_t k = 0; k < operands.size(); ++k) from[k] = &reg(frame, operands[k]);
    results_.resize(4);
    block_.call_texture(std::span<Register, 4>(results_), instruction,
                        std::span(from).first(operands.size()));
  }

  const std::vector<Prepared>& functions_;
  const StepLimit& limit_;
  Block block_;
  std::vector<Register> frames_;
  std::vector<Register> results_;          ///< Of the last call.
  std::vector<Register> results_pending_;  ///< Of the function being executed.
  double steps_left_ = 0;                  ///< Of the block; below zero: the run has failed.
};

std::vector<std::vector<std::uint32_t>> words_of_tables(const Program& program) {
  std::vector<std::vector<std::uint32_t>> tables;
  for (const auto& table : program.tables) {
    std::vector<std::uint32_t>& words = tables.emplace_back();
    for (const float value : table.values) {
      words.push_back(flush_denormal(std::bit_cast<std::uint32_t>(value)));
    }
  }
  return tables;
}

class Interpreter final : public Kernel {
 public:
  Interpreter(Program program, std::uint64_t max_steps)
      : program_(std::move(program)),
        limit_(program_, max_steps),
        functions_(prepare(program_)),
        tables_(words_of_tables(program_)) {}

  RunStatus run(const KernelArguments& arguments) const override {
    const ScopedFloatEnvironment environment;
    return Run(program_, tables_, functions_, limit_, arguments).all_blocks();
  }
  const Program& program() const override { return program_; }
  int lanes() const override { return block_lanes; }
  const char* engine() const override { return "interpreter"; }

 private:
  Program program_;
  StepLimit limit_;
  std::vector<Prepared> functions_;
  std::vector<std::vector<std::uint32_t>> tables_;
};

}  // namespace

std::unique_ptr<Kernel> make_interpreter(Program program, std::uint64_t max_steps) {
  return std::make_unique<Interpreter>(std::move(program), max_steps);
}

}  // namespace nacre
