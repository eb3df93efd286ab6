#include "runtime/reference/reference.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "runtime/float_environment.h"
#include "runtime/program/fold.h"
#include "runtime/program/region.h"
#include "runtime/reference/numbers.h"

namespace nacre {

namespace {

class Run {
 public:
  Run(const Program& program, const std::vector<FunctionCost>& costs, const StepLimit& limit,
      const KernelArguments& args, bool store_double, OpCounts* counts)
      : program_(program),
        costs_(costs),
        limit_(limit),
        args_(args),
        store_double_(store_double),
        counts_(counts) {}

  RunStatus point(std::uint64_t index) {
    point_ = index;
    steps_left_ = static_cast<double>(limit_.max_steps());
    call(0, {});
    if (steps_left_ < 0) return RunStatus::too_many_steps;
    return is_asked_to_stop() ? RunStatus::stopped : RunStatus::done;
  }

 private:
  struct Activation {
    const Function& function;
    const FunctionCost& cost;
    const std::vector<Value64>& arguments;
    std::vector<Value64> values;
    std::vector<Value64> results;
  };

  bool is_asked_to_stop() const {
    return args_.stop != nullptr && args_.stop->load(std::memory_order_relaxed) != 0;
  }

  std::vector<Value64> call(std::uint32_t number, const std::vector<Value64>& arguments) {
    const Function& function = program_.functions[number];
    Activation frame{.function = function,
                     .cost = costs_[number],
                     .arguments = arguments,
                     .values = std::vector<Value64>(function.code.size()),
                     .results = std::vector<Value64>(function.results.size())};
    run(frame, 0, function.code.size());
    return std::move(frame.results);
  }

  void run(Activation& frame, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Instruction& instruction = frame.function.code[i];
      if (!opens_region(instruction.op)) {
        step(frame, i, instruction);
        continue;
      }
      const std::size_t close = region_end(frame.function, i);
      if (instruction.op == Op::if_any) {
        run_if(frame, i, close);
      } else {
        run_loop(frame, i, close);
      }
      i = close;
    }
  }

  void run_if(Activation& frame, std::size_t open, std::size_t close) {
    const bool inside = frame.values[frame.function.code[open].operands[0]].i != 0;
    if (inside) run(frame, open + 1, close);
    for_each_own(frame.function, open, close, Op::merge, [&](std::size_t k) {
      const auto& operands = frame.function.code[k].operands;
      ensure_literal(frame, operands[1]);
      frame.values[k] = frame.values[operands[inside ? 0 : 1]];
    });
  }

  /// A literal stands wherever it was recorded, in a region not run yet too.
  void ensure_literal(Activation& frame, ValueId id) {
    const Instruction& instruction = frame.function.code[id];
    if (instruction.op == Op::constant) step(frame, id, instruction);
  }

  void run_loop(Activation& frame, std::size_t open, std::size_t close) {
    const Function& function = frame.function;
    for_each_own(function, open, close, Op::carry, [&](std::size_t k) {
      ensure_literal(frame, function.code[k].operands[0]);
      frame.values[k] = frame.values[function.code[k].operands[0]];
    });
    for_each_own(function, open, close, Op::next, [&](std::size_t k) {
      frame.values[k] = frame.values[function.code[k].operands[0]];
    });
    bool active = frame.values[function.code[open].operands[0]].i != 0;
    const std::uint32_t imm = function.code[open].imm;
    for (std::uint32_t n = 0; active; ++n) {
      if (n == loop_bound(imm)) {
        if ((imm & loop_must_end) != 0) steps_left_ = -1;
        return;
      }
      if (n > 0 && !pays_for_round(frame, open)) return;
      run(frame, open + 1, close);
      for_each_own(function, open, close, Op::next, [&](std::size_t k) {
        frame.values[k] = frame.values[function.code[k].operands[1]];
      });
      for_each_own(function, open, close, Op::next, [&](std::size_t k) {
        frame.values[function.code[k].operands[0]] = frame.values[k];
      });
      for_each_own(function, open, close, Op::again, [&](std::size_t k) {
        active = frame.values[function.code[k].operands[0]].i != 0;
      });
    }
  }

  /// False once there were too many steps, or somebody asks to stop: then the loops around
  /// end too, at their next round, and the point comes to its end.
  bool pays_for_round(const Activation& frame, std::size_t open) {
    if (!limit_.is_counted()) return true;
    steps_left_ -= frame.cost.rounds.at(static_cast<ValueId>(open));
    return steps_left_ >= 0 && !is_asked_to_stop();
  }

  /// f(index) for the instructions of kind `op` that stand in the region
  /// itself, not in one inside it.
  template <class F>
  static void for_each_own(const Function& function, std::size_t open, std::size_t close, Op op,
                           F&& f) {
    int depth = 0;
    for (std::size_t k = open + 1; k < close; ++k) {
      if (opens_region(function.code[k].op)) ++depth;
      if (closes_region(function.code[k].op)) --depth;
      if (depth == 0 && function.code[k].op == op) f(k);
    }
  }

  void step(Activation& frame, std::size_t i, const Instruction& instruction) {
    const auto operand = [&](std::size_t k) -> const Value64& {
      return frame.values[instruction.operands[k]];
    };
    const auto f = [&](std::size_t k) { return k < instruction.count ? operand(k).f : 0.0; };
    Value64& to = frame.values[i];
    if (counts_ != nullptr) ++(*counts_)[static_cast<std::size_t>(instruction.op)];
    switch (instruction.op) {
      case Op::constant: to = from_bits(instruction.type, instruction.imm); break;
      case Op::parameter:
        to = from_bits(instruction.type, args_.parameters[instruction.imm]);
        break;
      case Op::input:
        to = from_bits(instruction.type,
                       static_cast<const std::uint32_t*>(args_.inputs[instruction.imm])[point_]);
        break;
      case Op::argument: to = frame.arguments[instruction.imm]; break;
      case Op::select: to = operand(0).i != 0 ? operand(1) : operand(2); break;
      case Op::f_to_i: to.i = static_cast<std::uint32_t>(truncate_saturated(f(0))); break;
      case Op::i_to_f: to.f = static_cast<std::int32_t>(operand(0).i); break;
      case Op::u_to_f: to.f = operand(0).i; break;
      case Op::bits: to.i = bits_of(f(0)); break;
      case Op::from_bits: to.f = float_of(operand(0).i); break;
      case Op::half_to_f:
        to.f = static_cast<double>(half_to_float(static_cast<std::uint16_t>(operand(0).i)));
        break;
      case Op::table: to.f = table(instruction.imm, operand(0).i); break;
      case Op::texel: to.i = texel(operand(0).i, operand(1).i); break;
      case Op::texture_call: texture_call(frame, instruction); break;
      case Op::call: {
        std::vector<Value64> arguments;
        for (const ValueId id : frame.function.operands(instruction)) {
          arguments.push_back(frame.values[id]);
        }
        results_ = call(instruction.imm, arguments);
        break;
      }
      case Op::result: to = results_[instruction.imm]; break;
      case Op::give: frame.results[instruction.imm] = operand(0); break;
      case Op::keep: to = operand(0); break;
      case Op::store: store(instruction.imm, operand(0)); break;
      case Op::merge:
      case Op::carry:
      case Op::next:
      case Op::again: break;  // run_if and run_loop assign them.
      case Op::eq:
      case Op::ne:
      case Op::lt:
      case Op::le: to.i = compare(instruction.op, f(0), f(1)); break;
      default:
        if (instruction.type == Scalar::f32) {
          to.f = compute(instruction.op, f(0), f(1), f(2));
        } else {
          to.i = integer(instruction, frame);
        }
        break;
    }
  }

  static Value64 from_bits(Scalar type, std::uint32_t bits) {
    if (type == Scalar::f32) return {.f = float_of(bits), .i = 0};
    if (type == Scalar::b1) return {.f = 0.0, .i = bits != 0 ? 1u : 0u};
    return {.f = 0.0, .i = bits};
  }

  static std::uint32_t integer(const Instruction& instruction, const Activation& frame) {
    std::array<std::uint32_t, 3> operands{};
    for (std::size_t k = 0; k < instruction.count; ++k) {
      operands[k] = frame.values[instruction.operands[k]].i;
    }
    const auto folded = fold(instruction.op, std::span(operands).first(instruction.count));
    assert(folded.has_value());
    return *folded;
  }

  double table(std::uint32_t number, std::uint32_t index) const {
    const std::vector<float>& values = program_.tables[number].values;
    const auto last = static_cast<std::int32_t>(values.size()) - 1;
    const auto clamped = std::clamp(static_cast<std::int32_t>(index), 0, last);
    return static_cast<double>(values[static_cast<std::size_t>(clamped)]);
  }

  std::uint32_t texel(std::uint32_t slot, std::uint32_t word) const {
    const TextureBinding& texture = args_.textures[slot < program_.textures.size() ? slot : 0u];
    return texture.words[word < texture.count ? word : 0u];
  }

  void texture_call(const Activation& frame, const Instruction& instruction) {
    const auto operands = frame.function.operands(instruction);
    std::array<float, 6> x{};
    for (std::size_t k = 0; k < 6; ++k) {
      x[k] = static_cast<float>(frame.values[operands[k + 1]].f);
    }
    const auto limit =
        static_cast<std::int32_t>(operands.size() > 7 ? frame.values[operands[7]].i : 0u);
    std::array<float, 4> rgba{};
    const TextureCall request{.slot = frame.values[operands[0]].i,
                              .modes = instruction.imm,
                              .lanes = 1,
                              .u = &x[0],
                              .v = &x[1],
                              .dudx = &x[2],
                              .dvdx = &x[3],
                              .dudy = &x[4],
                              .dvdy = &x[5],
                              .max_anisotropy = operands.size() > 7 ? &limit : nullptr,
                              .rgba = rgba.data()};
    if (args_.texture_callback != nullptr) args_.texture_callback(args_.texture_user, &request);
    results_.assign(4, {});
    for (std::size_t c = 0; c < 4; ++c) results_[c].f = static_cast<double>(rgba[c]);
  }

  void store(std::uint32_t channel, const Value64& value) const {
    const Scalar type = program_.outputs[channel].type;
    if (type == Scalar::f32 && store_double_) {
      static_cast<double*>(args_.outputs[channel])[point_] = value.f;
      return;
    }
    static_cast<std::uint32_t*>(args_.outputs[channel])[point_] =
        type == Scalar::f32 ? bits_of(value.f) : value.i;
  }

  const Program& program_;
  const std::vector<FunctionCost>& costs_;
  const StepLimit& limit_;
  const KernelArguments& args_;
  bool store_double_;
  OpCounts* counts_;  ///< Null: nobody counts.
  std::uint64_t point_ = 0;
  double steps_left_ = 0;  ///< Of the point; below zero: the run has failed.
  std::vector<Value64> results_;
};

class Reference final : public ReferenceKernel {
 public:
  Reference(Program program, std::uint64_t max_steps)
      : program_(std::move(program)),
        costs_(function_costs(program_)),
        limit_(program_, max_steps) {}

  RunStatus run(const KernelArguments& arguments) const override {
    return run_all(arguments, false, nullptr);
  }
  RunStatus run_double(const KernelArguments& arguments) const override {
    return run_all(arguments, true, nullptr);
  }
  RunStatus run_counted(const KernelArguments& arguments, OpCounts& counts) const override {
    return run_all(arguments, false, &counts);
  }
  const Program& program() const override { return program_; }
  int lanes() const override { return 1; }
  const char* engine() const override { return "reference"; }

 private:
  RunStatus run_all(const KernelArguments& arguments, bool store_double, OpCounts* counts) const {
    const ScopedFloatEnvironment environment;
    Run run(program_, costs_, limit_, arguments, store_double, counts);
    for (std::uint64_t i = 0; i < arguments.count; ++i) {
      if (const RunStatus status = run.point(i); status != RunStatus::done) return status;
    }
    return RunStatus::done;
  }

  Program program_;
  std::vector<FunctionCost> costs_;
  StepLimit limit_;
};

}  // namespace

std::unique_ptr<ReferenceKernel> make_reference(Program program, std::uint64_t max_steps) {
  return std::make_unique<Reference>(std::move(program), max_steps);
}

}  // namespace nacre
