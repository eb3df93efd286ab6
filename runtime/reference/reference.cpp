#include "runtime/reference/reference.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "runtime/float_environment.h"
#include "runtime/program/fold.h"
#include "runtime/program/region.h"
#include "runtime/reference/numbers.h"

namespace nacre {

namespace {

/// Points that are worked on at once: as many as share the cost of finding out what to do.
constexpr std::uint32_t points_at_once = 16;

/// Columns of values: of each of some things, that of every point.
class Columns {
 public:
  Columns() = default;
  explicit Columns(std::size_t count) : values_(count * points_at_once) {}

  Value64* operator[](std::size_t k) { return values_.data() + k * points_at_once; }
  const Value64* operator[](std::size_t k) const { return values_.data() + k * points_at_once; }

 private:
  std::vector<Value64> values_;
};

/// Each point is computed as if it were alone: regions are entered with the points that do.
class Run {
 public:
  Run(const Program& program, const std::vector<FunctionCost>& costs, const StepLimit& limit,
      const KernelArguments& args, bool store_double, OpCounts* counts)
      : program_(program),
        costs_(costs),
        limit_(limit),
        args_(args),
        store_double_(store_double),
        counts_(counts) {
    std::iota(numbers_.begin(), numbers_.end(), 0u);
  }

  /// At most points_at_once.
  RunStatus points(std::uint64_t first, std::size_t count) {
    first_ = first;
    steps_left_.fill(static_cast<double>(limit_.max_steps()));
    call(0, Columns(), Points64(numbers_).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (steps_left_[i] < 0) return RunStatus::too_many_steps;
    }
    return is_asked_to_stop() ? RunStatus::stopped : RunStatus::done;
  }

 private:
  struct Activation {
    const Function& function;
    const FunctionCost& cost;
    const Columns& arguments;
    Columns values;
    Columns results;
  };

  /// Some points, made less.
  using Some = std::vector<std::uint32_t>;

  bool is_asked_to_stop() const {
    return args_.stop != nullptr && args_.stop->load(std::memory_order_relaxed) != 0;
  }

  Columns call(std::uint32_t number, const Columns& arguments, Points64 points) {
    const Function& function = program_.functions[number];
    Activation frame{.function = function,
                     .cost = costs_[number],
                     .arguments = arguments,
                     .values = Columns(function.code.size()),
                     .results = Columns(function.results.size())};
    run(frame, 0, function.code.size(), points);
    return std::move(frame.results);
  }

  void run(Activation& frame, std::size_t first, std::size_t end, Points64 points) {
    for (std::size_t i = first; i < end; ++i) {
      const Instruction& instruction = frame.function.code[i];
      if (!opens_region(instruction.op)) {
        step(frame, i, instruction, points);
        continue;
      }
      const std::size_t close = region_end(frame.function, i);
      if (instruction.op == Op::if_any) {
        run_if(frame, i, close, points);
      } else {
        run_loop(frame, i, close, points);
      }
      i = close;
    }
  }

  static void copy(const Value64* from, Value64* to, Points64 points) {
    for (const std::uint32_t p : points) to[p] = from[p];
  }

  void run_if(Activation& frame, std::size_t open, std::size_t close, Points64 points) {
    const Value64* const condition = frame.values[frame.function.code[open].operands[0]];
    Some inside, outside;
    for (const std::uint32_t p : points) (condition[p].i != 0 ? inside : outside).push_back(p);
    if (!inside.empty()) run(frame, open + 1, close, inside);
    for_each_own(frame.function, open, close, Op::merge, [&](std::size_t k) {
      const auto& operands = frame.function.code[k].operands;
      ensure_literal(frame, operands[1], points);
      copy(frame.values[operands[0]], frame.values[k], inside);
      copy(frame.values[operands[1]], frame.values[k], outside);
    });
  }

  /// A literal stands wherever it was recorded, in a region not run yet too.
  void ensure_literal(Activation& frame, ValueId id, Points64 points) {
    const Instruction& instruction = frame.function.code[id];
    if (instruction.op == Op::constant) step(frame, id, instruction, points);
  }

  void run_loop(Activation& frame, std::size_t open, std::size_t close, Points64 points) {
    const Function& function = frame.function;
    for_each_own(function, open, close, Op::carry, [&](std::size_t k) {
      ensure_literal(frame, function.code[k].operands[0], points);
      copy(frame.values[function.code[k].operands[0]], frame.values[k], points);
    });
    for_each_own(function, open, close, Op::next, [&](std::size_t k) {
      copy(frame.values[function.code[k].operands[0]], frame.values[k], points);
    });
    Some active(points.begin(), points.end());
    const auto keep_where = [&](ValueId id) {
      std::erase_if(active, [&](std::uint32_t p) { return frame.values[id][p].i == 0; });
    };
    keep_where(function.code[open].operands[0]);
    const std::uint32_t imm = function.code[open].imm;
    for (std::uint32_t n = 0; !active.empty(); ++n) {
      if (n == loop_bound(imm)) {
        if ((imm & loop_must_end) != 0) {
          for (const std::uint32_t p : active) steps_left_[p] = -1;
        }
        return;
      }
      if (n > 0) keep_paying(frame, open, active);
      if (active.empty()) return;
      run(frame, open + 1, close, active);
      for_each_own(function, open, close, Op::next, [&](std::size_t k) {
        copy(frame.values[function.code[k].operands[1]], frame.values[k], active);
      });
      for_each_own(function, open, close, Op::next, [&](std::size_t k) {
        copy(frame.values[k], frame.values[function.code[k].operands[0]], active);
      });
      for_each_own(function, open, close, Op::again,
                   [&](std::size_t k) { keep_where(function.code[k].operands[0]); });
    }
  }

  /// Leaves out those that took too many steps, and all once somebody asks to stop: then the
  /// loops around end too, at their next round, and the points come to their end.
  void keep_paying(const Activation& frame, std::size_t open, Some& active) {
    if (!limit_.is_counted()) return;
    const double cost = frame.cost.rounds.at(static_cast<ValueId>(open));
    for (const std::uint32_t p : active) steps_left_[p] -= cost;
    const bool stops = is_asked_to_stop();
    std::erase_if(active, [&](std::uint32_t p) { return stops || steps_left_[p] < 0; });
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

  void step(Activation& frame, std::size_t i, const Instruction& instruction, Points64 points) {
    const auto operand = [&](std::size_t k) -> const Value64* {
      return k < instruction.count ? frame.values[instruction.operands[k]] : zeros_.data();
    };
    Value64* const to = frame.values[i];
    const Value64 *const a = operand(0), *const b = operand(1), *const c = operand(2);
    const auto each = [&](auto&& f) {
      for (const std::uint32_t p : points) f(p);
    };
    const auto fill = [&](const Value64& value) { each([&](std::uint32_t p) { to[p] = value; }); };
    if (counts_ != nullptr) {
      (*counts_)[static_cast<std::size_t>(instruction.op)] += points.size();
    }
    switch (instruction.op) {
      case Op::constant: fill(from_bits(instruction.type, instruction.imm)); break;
      case Op::parameter:
        fill(from_bits(instruction.type, args_.parameters[instruction.imm]));
        break;
      case Op::input: {
        const auto* const column =
            static_cast<const std::uint32_t*>(args_.inputs[instruction.imm]) + first_;
        each([&](std::uint32_t p) { to[p] = from_bits(instruction.type, column[p]); });
        break;
      }
      case Op::argument: copy(frame.arguments[instruction.imm], to, points); break;
      case Op::select: each([&](std::uint32_t p) { to[p] = a[p].i != 0 ? b[p] : c[p]; }); break;
      case Op::f_to_i:
        each([&](std::uint32_t p) {
          to[p].i = static_cast<std::uint32_t>(truncate_saturated(a[p].f));
        });
        break;
      case Op::i_to_f:
        each([&](std::uint32_t p) { to[p].f = static_cast<std::int32_t>(a[p].i); });
        break;
      case Op::u_to_f: each([&](std::uint32_t p) { to[p].f = a[p].i; }); break;
      case Op::bits: each([&](std::uint32_t p) { to[p].i = bits_of(a[p].f); }); break;
      case Op::from_bits: each([&](std::uint32_t p) { to[p].f = float_of(a[p].i); }); break;
      case Op::half_to_f:
        each([&](std::uint32_t p) {
          to[p].f = static_cast<double>(half_to_float(static_cast<std::uint16_t>(a[p].i)));
        });
        break;
      case Op::table:
        each([&](std::uint32_t p) { to[p].f = table(instruction.imm, a[p].i); });
        break;
      case Op::fitted:
        each([&](std::uint32_t p) { to[p].f = fitted(instruction.imm, a[p].i); });
        break;
      case Op::texel: each([&](std::uint32_t p) { to[p].i = texel(a[p].i, b[p].i); }); break;
      case Op::texture_call:
        results_ = Columns(4);
        each([&](std::uint32_t p) { texture_call(frame, instruction, p); });
        break;
      case Op::call: {
        const auto operands = frame.function.operands(instruction);
        Columns arguments(operands.size());
        for (std::size_t k = 0; k < operands.size(); ++k) {
          copy(frame.values[operands[k]], arguments[k], points);
        }
        results_ = call(instruction.imm, arguments, points);
        break;
      }
      case Op::result: copy(results_[instruction.imm], to, points); break;
      case Op::give: copy(a, frame.results[instruction.imm], points); break;
      case Op::keep: copy(a, to, points); break;
      case Op::store: store(instruction.imm, a, points); break;
      case Op::merge:
      case Op::carry:
      case Op::next:
      case Op::again: break;  // run_if and run_loop assign them.
      case Op::eq:
      case Op::ne:
      case Op::lt:
      case Op::le:
        each([&](std::uint32_t p) { to[p].i = compare(instruction.op, a[p].f, b[p].f); });
        break;
      default:
        if (instruction.type == Scalar::f32) {
          compute(instruction.op, points, a, b, c, to);
        } else {
          each([&](std::uint32_t p) { to[p].i = integer(instruction, {a[p].i, b[p].i, c[p].i}); });
        }
        break;
    }
  }

  static Value64 from_bits(Scalar type, std::uint32_t bits) {
    if (type == Scalar::f32) return {.f = float_of(bits), .i = 0};
    if (type == Scalar::b1) return {.f = 0.0, .i = bits != 0 ? 1u : 0u};
    return {.f = 0.0, .i = bits};
  }

  static std::uint32_t integer(const Instruction& instruction,
                               const std::array<std::uint32_t, 3>& operands) {
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

  double fitted(std::uint32_t row, std::uint32_t index) const {
    if (args_.fitted == nullptr) return 0.0;
    return static_cast<double>(args_.fitted[Fit::cells * row + index % Fit::cells]);
  }

  std::uint32_t texel(std::uint32_t slot, std::uint32_t word) const {
    const TextureBinding& texture = args_.textures[slot < program_.textures.size() ? slot : 0u];
    return texture.words[word < texture.count ? word : 0u];
  }

  void texture_call(const Activation& frame, const Instruction& instruction, std::uint32_t point) {
    const auto operands = frame.function.operands(instruction);
    const auto value = [&](std::size_t k) { return frame.values[operands[k]][point]; };
    std::array<float, 6> x{};
    for (std::size_t k = 0; k < 6; ++k) x[k] = static_cast<float>(value(k + 1).f);
    const auto limit = static_cast<std::int32_t>(operands.size() > 7 ? value(7).i : 0u);
    std::array<float, 4> rgba{};
    const TextureCall request{.slot = value(0).i,
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
    for (std::size_t c = 0; c < 4; ++c) results_[c][point].f = static_cast<double>(rgba[c]);
  }

  void store(std::uint32_t channel, const Value64* values, Points64 points) const {
    const bool is_float = program_.outputs[channel].type == Scalar::f32;
    if (is_float && store_double_) {
      auto* const to = static_cast<double*>(args_.outputs[channel]) + first_;
      for (const std::uint32_t p : points) to[p] = values[p].f;
      return;
    }
    auto* const to = static_cast<std::uint32_t*>(args_.outputs[channel]) + first_;
    for (const std::uint32_t p : points) to[p] = is_float ? bits_of(values[p].f) : values[p].i;
  }

  const Program& program_;
  const std::vector<FunctionCost>& costs_;
  const StepLimit& limit_;
  const KernelArguments& args_;
  bool store_double_;
  OpCounts* counts_;         ///< Null: nobody counts.
  std::uint64_t first_ = 0;  ///< Of the points that are worked on.
  std::array<std::uint32_t, points_at_once> numbers_{};
  std::array<double, points_at_once> steps_left_{};  ///< Below zero: the run has failed.
  Columns results_;
  const std::array<Value64, points_at_once> zeros_{};  ///< Operands that an operation lacks.
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
    for (std::uint64_t i = 0; i < arguments.count; i += points_at_once) {
      const std::uint64_t count = std::min<std::uint64_t>(points_at_once, arguments.count - i);
      if (const RunStatus status = run.points(i, count); status != RunStatus::done) return status;
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
