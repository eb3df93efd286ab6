#include "runtime/interpreter/interpreter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "runtime/float_environment.h"
#include "runtime/interpreter/lanes.h"
#include "runtime/interpreter/registers.h"
#include "runtime/program/fold.h"

namespace nacre {

namespace {

constexpr std::uint32_t all_ones = ~0u;

/// A function with its registers assigned and its regions' ends found.
struct Prepared {
  const Function* function;
  RegisterMap registers;
  std::vector<bool> once;
  std::vector<std::size_t> end;  ///< By opening instruction: the closing one.
  std::vector<double> round;     ///< By instruction that opens a loop: steps of a round.
};

Prepared prepare(const Function& function, const FunctionCost& cost) {
  Prepared prepared{.function = &function,
                    .registers = assign_registers(function),
                    .once = once_per_call(function),
                    .end = std::vector<std::size_t>(function.code.size(), 0),
                    .round = std::vector<double>(function.code.size(), 0)};
  for (const auto& [open, steps] : cost.rounds) prepared.round[open] = steps;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    if (opens_region(function.code[i].op)) open.push_back(i);
    if (!closes_region(function.code[i].op)) continue;
    prepared.end[open.back()] = i;
    open.pop_back();
  }
  return prepared;
}

bool any(const Register& mask) {
  return std::any_of(mask.begin(), mask.end(), [](std::uint32_t lane) { return lane != 0; });
}

/// The state of one run() on one thread.
class Run {
 public:
  Run(const Program& program, const std::vector<Prepared>& functions, const StepLimit& limit,
      const KernelArguments& args)
      : program_(program), functions_(functions), limit_(limit), args_(args), ops_(lane_ops()) {}

  RunStatus all_blocks() {
    const Prepared& entry = functions_.front();
    frames_.resize(entry.registers.count);
    Frame frame{.base = 0, .prepared = &entry};
    fill_once(frame);
    for (first_ = 0; first_ < args_.count; first_ += block_lanes) {
      lanes_ = static_cast<int>(std::min<std::uint64_t>(block_lanes, args_.count - first_));
      steps_left_ = static_cast<double>(limit_.max_steps());
      execute(frame);
      if (steps_left_ < 0) return RunStatus::too_many_steps;
      if (is_asked_to_stop()) return RunStatus::stopped;
    }
    return RunStatus::done;
  }

 private:
  /// A function being executed: its registers are frames_[base ...].
  struct Frame {
    std::size_t base;
    const Prepared* prepared;
    std::span<const ValueId> arguments{};  ///< The caller's values.
    const Frame* caller = nullptr;
    std::size_t results = 0;  ///< Where `give` writes: registers of the caller's call.
  };
  struct LoopState {
    std::size_t start;
    std::uint32_t iteration = 0;
    Register active;
  };

  bool is_asked_to_stop() const {
    return args_.stop != nullptr && args_.stop->load(std::memory_order_relaxed) != 0;
  }

  Register& reg(const Frame& frame, ValueId id) {
    return frames_[frame.base + frame.prepared->registers.of[id]];
  }
  const std::uint32_t* data(const Frame& frame, ValueId id) {
    return id == no_value ? nullptr : reg(frame, id).data();
  }

  static std::uint32_t as_lane(const Instruction& constant) {
    if (constant.type == Scalar::f32) return flush_denormal(constant.imm);
    if (constant.type == Scalar::i32) return constant.imm;
    return constant.imm != 0 ? all_ones : 0u;
  }

  /// Constants, and in the entry also what is uniform at top level.
  void fill_once(const Frame& frame) {
    const Function& function = *frame.prepared->function;
    const bool is_entry = frame.caller == nullptr;
    for (std::size_t i = 0; i < function.code.size(); ++i) {
      const Instruction& instruction = function.code[i];
      if (instruction.op == Op::constant) {
        reg(frame, static_cast<ValueId>(i)).fill(as_lane(instruction));
      } else if (is_entry && frame.prepared->once[i]) {
        step(frame, static_cast<ValueId>(i), instruction);
      }
    }
  }

  void execute(const Frame& frame) {
    const Function& function = *frame.prepared->function;
    const bool is_entry = frame.caller == nullptr;
    std::vector<LoopState> loops;
    for (std::size_t i = 0; i < function.code.size(); ++i) {
      const Instruction& instruction = function.code[i];
      const auto id = static_cast<ValueId>(i);
      if (instruction.op == Op::constant || (is_entry && frame.prepared->once[i])) continue;
      switch (instruction.op) {
        case Op::if_any: i = open_if(frame, i); break;
        case Op::merge:
          blend(frame, id, mask_of_if(frame, i), instruction.operands[0], instruction.operands[1]);
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
        default: step(frame, id, instruction); break;
      }
    }
  }

  /// The mask of the innermost if_any around instruction i.
  const Register& mask_of_if(const Frame& frame, std::size_t i) {
    const Function& function = *frame.prepared->function;
    std::size_t open = i;
    do {
      --open;
    } while (function.code[open].op != Op::if_any || frame.prepared->end[open] < i);
    return reg(frame, function.code[open].operands[0]);
  }

  void blend(const Frame& frame, ValueId to, const Register& mask, ValueId yes, ValueId no) {
    const Register& a = reg(frame, yes);
    const Register& b = reg(frame, no);
    Register& result = reg(frame, to);
    for (int k = 0; k < block_lanes; ++k) result[k] = mask[k] != 0 ? a[k] : b[k];
  }

  /// Enters the region, or gives its merges their outer values and skips it.
  std::size_t open_if(const Frame& frame, std::size_t i) {
    const Function& function = *frame.prepared->function;
    if (any(reg(frame, function.code[i].operands[0]))) return i;
    const std::size_t end = frame.prepared->end[i];
    int depth = 0;
    for (std::size_t k = i + 1; k < end; ++k) {
      const Instruction& inner = function.code[k];
      if (opens_region(inner.op)) ++depth;
      if (closes_region(inner.op)) --depth;
      if (depth == 0 && inner.op == Op::merge) {
        reg(frame, static_cast<ValueId>(k)) = reg(frame, inner.operands[1]);
      }
    }
    return end;
  }

  std::size_t open_loop(const Frame& frame, std::size_t i, std::vector<LoopState>& loops) {
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

  std::size_t close_loop(const Frame& frame, std::size_t i, std::vector<LoopState>& loops) {
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
  bool pays_for_round(const Frame& frame, std::size_t opening) {
    if (!limit_.is_counted()) return true;
    steps_left_ -= frame.prepared->round[opening];
    return steps_left_ >= 0 && !is_asked_to_stop();
  }

  template <class F>
  void for_each_next(const Frame& frame, std::size_t opening, F&& f) {
    const Function& function = *frame.prepared->function;
    int depth = 0;
    for (std::size_t k = opening + 1; k < frame.prepared->end[opening]; ++k) {
      const Instruction& inner = function.code[k];
      if (opens_region(inner.op)) ++depth;
      if (closes_region(inner.op)) --depth;
      if (depth == 0 && inner.op == Op::next) f(static_cast<ValueId>(k), inner.operands[0]);
    }
  }

  void step(const Frame& frame, ValueId id, const Instruction& instruction) {
    if (const LaneOp op = ops_[static_cast<std::size_t>(instruction.op)]; op != nullptr) {
      op(reg(frame, id).data(), data(frame, instruction.operands[0]),
         data(frame, instruction.operands[1]), data(frame, instruction.operands[2]));
      return;
    }
    switch (instruction.op) {
      case Op::parameter: {
        std::uint32_t bits = args_.parameters[instruction.imm];
        if (instruction.type == Scalar::f32) bits = flush_denormal(bits);
        if (instruction.type == Scalar::b1) bits = bits != 0 ? all_ones : 0u;
        reg(frame, id).fill(bits);
        break;
      }
      case Op::input: load_input(frame, id, instruction); break;
      case Op::argument:
        reg(frame, id) = reg(*frame.caller, frame.arguments[instruction.imm]);
        break;
      case Op::table: load_table(frame, id, instruction); break;
      case Op::texel: load_texel(frame, id, instruction); break;
      case Op::call: call(frame, instruction); break;
      case Op::texture_call: texture_call(frame, instruction); break;
      case Op::result: reg(frame, id) = results_[instruction.imm]; break;
      case Op::give:
        results_pending_.resize(frame.prepared->function->results.size());
        results_pending_[instruction.imm] = reg(frame, instruction.operands[0]);
        break;
      case Op::store: store(frame, instruction); break;
      default: assert(false && "an operation that the passes should have expanded");
    }
  }

  void load_input(const Frame& frame, ValueId id, const Instruction& instruction) {
    const auto* source = static_cast<const std::uint32_t*>(args_.inputs[instruction.imm]) + first_;
    Register& to = reg(frame, id);
    for (int k = 0; k < block_lanes; ++k) {
      // Beyond the batch the last point is repeated: no lane takes a way of its own.
      const std::uint32_t bits = source[std::min(k, lanes_ - 1)];
      if (instruction.type == Scalar::f32) to[k] = flush_denormal(bits);
      if (instruction.type == Scalar::i32) to[k] = bits;
      if (instruction.type == Scalar::b1) to[k] = bits != 0 ? all_ones : 0u;
    }
  }

  void load_table(const Frame& frame, ValueId id, const Instruction& instruction) {
    const std::vector<float>& values = program_.tables[instruction.imm].values;
    const Register& index = reg(frame, instruction.operands[0]);
    const auto last = static_cast<std::int32_t>(values.size()) - 1;
    Register& to = reg(frame, id);
    for (int k = 0; k < block_lanes; ++k) {
      const auto clamped = std::clamp(static_cast<std::int32_t>(index[k]), 0, last);
      to[k] =
          flush_denormal(std::bit_cast<std::uint32_t>(values[static_cast<std::size_t>(clamped)]));
    }
  }

  void load_texel(const Frame& frame, ValueId id, const Instruction& instruction) {
    const Register& slot = reg(frame, instruction.operands[0]);
    const Register& word = reg(frame, instruction.operands[1]);
    Register& to = reg(frame, id);
    for (int k = 0; k < block_lanes; ++k) {
      const std::uint32_t number = slot[k] < program_.textures.size() ? slot[k] : 0u;
      const TextureBinding& texture = args_.textures[number];
      to[k] = texture.words[word[k] < texture.count ? word[k] : 0u];
    }
  }

  void call(const Frame& frame, const Instruction& instruction) {
    const Prepared& callee = functions_[instruction.imm];
    const std::size_t base = frame.base + frame.prepared->registers.count;
    if (frames_.size() < base + callee.registers.count) {
      frames_.resize(base + callee.registers.count);
    }
    const Frame inner{.base = base,
                      .prepared = &callee,
                      .arguments = frame.prepared->function->operands(instruction),
                      .caller = &frame};
    fill_once(inner);
    execute(inner);
    std::swap(results_, results_pending_);
  }

  void texture_call(const Frame& frame, const Instruction& instruction) {
    const auto operands = frame.prepared->function->operands(instruction);
    const auto floats = [&](std::size_t k) {
      return reinterpret_cast<const float*>(reg(frame, operands[k]).data());
    };
    std::array<float, 4 * block_lanes> rgba{};
    const TextureCall request{.slot = reg(frame, operands[0])[0],
                              .modes = instruction.imm,
                              .lanes = block_lanes,
                              .u = floats(1),
                              .v = floats(2),
                              .dudx = floats(3),
                              .dvdx = floats(4),
                              .dudy = floats(5),
                              .dvdy = floats(6),
                              .rgba = rgba.data()};
    if (args_.texture_callback != nullptr) args_.texture_callback(args_.texture_user, &request);
    results_.resize(4);
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 0; k < block_lanes; ++k) {
        results_[c][k] = flush_denormal(std::bit_cast<std::uint32_t>(rgba[c * block_lanes + k]));
      }
    }
  }

  void store(const Frame& frame, const Instruction& instruction) {
    const Register& value = reg(frame, instruction.operands[0]);
    const Scalar type = program_.outputs[instruction.imm].type;
    auto* to = static_cast<std::uint32_t*>(args_.outputs[instruction.imm]) + first_;
    for (int k = 0; k < lanes_; ++k) {
      std::uint32_t bits = value[k];
      if (type == Scalar::f32 && (bits & 0x7fffffffu) > 0x7f800000u) bits = canonical_nan;
      if (type == Scalar::b1) bits &= 1u;
      to[k] = bits;
    }
  }

  const Program& program_;
  const std::vector<Prepared>& functions_;
  const StepLimit& limit_;
  const KernelArguments& args_;
  const LaneOps& ops_;
  std::vector<Register> frames_;
  std::vector<Register> results_;          ///< Of the last call.
  std::vector<Register> results_pending_;  ///< Of the function being executed.
  std::uint64_t first_ = 0;
  int lanes_ = block_lanes;
  double steps_left_ = 0;  ///< Of the block; below zero: the run has failed.
};

class Interpreter final : public Kernel {
 public:
  Interpreter(Program program, std::uint64_t max_steps)
      : program_(std::move(program)), limit_(program_, max_steps) {
    const std::vector<FunctionCost> costs = function_costs(program_);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      functions_.push_back(prepare(program_.functions[i], costs[i]));
    }
  }

  RunStatus run(const KernelArguments& arguments) const override {
    const ScopedFloatEnvironment environment;
    return Run(program_, functions_, limit_, arguments).all_blocks();
  }
  const Program& program() const override { return program_; }
  int lanes() const override { return block_lanes; }
  const char* engine() const override { return "interpreter"; }

 private:
  Program program_;
  StepLimit limit_;
  std::vector<Prepared> functions_;
};

}  // namespace

std::unique_ptr<Kernel> make_interpreter(Program program, std::uint64_t max_steps) {
  return std::make_unique<Interpreter>(std::move(program), max_steps);
}

}  // namespace nacre
