#include "jit/passes/contract.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/parse.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/reference/reference.h"
#include "runtime/value/control.h"
#include "tests/support/random.h"
#include "tests/support/random_program.h"

namespace nacre {
namespace {

std::size_t count(const Program& program, Op op) {
  std::size_t found = 0;
  for (const Function& function : program.functions) {
    for (const Instruction& instruction : function.code) found += instruction.op == op ? 1u : 0u;
  }
  return found;
}

/// The printed result for a printed entry; inputs a, b, c, d are %0 ... %3.
std::string contracted(std::string_view code) {
  std::string text = "program t\nparameter f32 p = 1\nparameter f32 q = 1\nentry\n";
  for (const char* name :
       {"0 = f32 input a", "1 = f32 input b", "2 = f32 input c", "3 = f32 input d"}) {
    text += fmt::format("  %{}\n", name);
  }
  Diagnostics diagnostics;
  std::optional<Program> program = parse_program(text + std::string(code), diagnostics);
  if (!program) return diagnostics.to_string();
  remove_dead(*program);  // Inputs not used.
  const std::string result = to_string(contract(*program));
  return result.substr(result.find("entry\n") + 6);
}

struct Golden {
  const char* what;
  const char* before;
  const char* after;
};

TEST(Contract, Golden) {
  const std::vector<Golden> cases{
      {"a b + c",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 add %2 %4\n"
       "  store out %5\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 fma %0 %1 %2\n"
       "  store out %3\n"},
      {"a b - c",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 sub %4 %2\n"
       "  store out %5\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 neg %2\n"
       "  %4 = f32 fma %0 %1 %3\n"
       "  store out %4\n"},
      {"c - a b",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 sub %2 %4\n"
       "  store out %5\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 neg %0\n"
       "  %4 = f32 fma %3 %1 %2\n"
       "  store out %4\n"},
      {"c - 2 a: the sign goes to the literal",
       "  %4 = f32 const 2\n"
       "  %5 = f32 mul %0 %4\n"
       "  %6 = f32 sub %2 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input c\n"
       "  %2 = f32 const -2\n"
       "  %3 = f32 fma %0 %2 %1\n"
       "  store out %3\n"},
      {"-(a b) + c",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 neg %4\n"
       "  %6 = f32 add %2 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 neg %0\n"
       "  %4 = f32 fma %3 %1 %2\n"
       "  store out %4\n"},
      {"c - -(a b): the signs cancel",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 neg %4\n"
       "  %6 = f32 sub %2 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 fma %0 %1 %2\n"
       "  store out %3\n"},
      {"c - (-a) b: the sign meets the neg",
       "  %4 = f32 neg %0\n"
       "  %5 = f32 mul %1 %4\n"
       "  %6 = f32 sub %2 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 fma %1 %0 %2\n"
       "  store out %3\n"},
      {"a b - (-c): likewise",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 neg %2\n"
       "  %6 = f32 sub %4 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 fma %0 %1 %2\n"
       "  store out %3\n"},
      {"a b + c d: one of them, whichever was recorded first",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 mul %2 %3\n"
       "  %6 = f32 add %4 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 input d\n"
       "  %4 = f32 mul %2 %3\n"
       "  %5 = f32 fma %0 %1 %4\n"
       "  store out %5\n"},
      {"a b + (c + d) d: the deeper product",
       "  %4 = f32 add %2 %3\n"
       "  %5 = f32 mul %3 %4\n"
       "  %6 = f32 mul %0 %1\n"
       "  %7 = f32 add %5 %6\n"
       "  store out %7\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 input d\n"
       "  %4 = f32 add %2 %3\n"
       "  %5 = f32 mul %0 %1\n"
       "  %6 = f32 fma %3 %4 %5\n"
       "  store out %6\n"},
      {"a b in two sums: both, and the product goes",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 add %2 %4\n"
       "  %6 = f32 add %3 %4\n"
       "  store one %5\n"
       "  store two %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 input d\n"
       "  %4 = f32 fma %0 %1 %2\n"
       "  %5 = f32 fma %0 %1 %3\n"
       "  store one %4\n"
       "  store two %5\n"},
      {"a b needed elsewhere",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 add %2 %4\n"
       "  store one %5\n"
       "  store two %4\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 mul %0 %1\n"
       "  %4 = f32 add %2 %3\n"
       "  store one %4\n"
       "  store two %3\n"},
      {"a b + a b",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 add %4 %4\n"
       "  store out %5\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 mul %0 %1\n"
       "  %3 = f32 add %2 %2\n"
       "  store out %3\n"},
      {"the error of a product: a b - round(a b) stays",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 neg %4\n"
       "  %6 = f32 fma %0 %1 %5\n"
       "  %7 = f32 add %4 %6\n"
       "  store out %7\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 mul %0 %1\n"
       "  %3 = f32 neg %2\n"
       "  %4 = f32 fma %0 %1 %3\n"
       "  %5 = f32 add %2 %4\n"
       "  store out %5\n"},
      {"a keep between",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = f32 keep 0 %4\n"
       "  %6 = f32 add %2 %5\n"
       "  store out %6\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = f32 mul %0 %1\n"
       "  %4 = f32 keep 0 %3\n"
       "  %5 = f32 add %2 %4\n"
       "  store out %5\n"},
      {"a uniform product in a varying sum is free",
       "  %4 = f32 param p\n"
       "  %5 = f32 param q\n"
       "  %6 = f32 mul %4 %5\n"
       "  %7 = f32 add %0 %6\n"
       "  store out %7\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 param p\n"
       "  %2 = f32 param q\n"
       "  %3 = f32 mul %1 %2\n"
       "  %4 = f32 add %0 %3\n"
       "  store out %4\n"},
      {"a uniform product in a uniform sum is not",
       "  %4 = f32 param p\n"
       "  %5 = f32 param q\n"
       "  %6 = f32 mul %4 %5\n"
       "  %7 = f32 add %4 %6\n"
       "  store out %7\n",
       "  %0 = f32 param p\n"
       "  %1 = f32 param q\n"
       "  %2 = f32 fma %0 %1 %0\n"
       "  store out %2\n"},
      {"into a region",
       "  %4 = f32 mul %0 %1\n"
       "  %5 = b1 lt %0 %1\n"
       "  if_any %5\n"
       "    %7 = f32 sub %2 %4\n"
       "    %8 = f32 merge %7 %2\n"
       "  end_if\n"
       "  store out %8\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = b1 lt %0 %1\n"
       "  if_any %3\n"
       "    %5 = f32 neg %0\n"
       "    %6 = f32 fma %5 %1 %2\n"
       "    %7 = f32 merge %6 %2\n"
       "  end_if\n"
       "  store out %7\n"},
      {"not across a merge",
       "  %4 = b1 lt %0 %1\n"
       "  if_any %4\n"
       "    %6 = f32 mul %0 %1\n"
       "    %7 = f32 merge %6 %2\n"
       "  end_if\n"
       "  %9 = f32 add %2 %7\n"
       "  store out %9\n",
       "  %0 = f32 input a\n"
       "  %1 = f32 input b\n"
       "  %2 = f32 input c\n"
       "  %3 = b1 lt %0 %1\n"
       "  if_any %3\n"
       "    %5 = f32 mul %0 %1\n"
       "    %6 = f32 merge %5 %2\n"
       "  end_if\n"
       "  %8 = f32 add %2 %6\n"
       "  store out %8\n"},
  };
  for (const Golden& golden : cases) {
    EXPECT_EQ(contracted(golden.before), golden.after) << golden.what;
  }
}

TEST(Contract, AProductThatLostMayGoWhenItsRivalIsGone) {
  // %4 wins over %5 in the first sum, then loses to %6 in the second: it stays,
  // and the first sum takes %5 after all.
  const std::string result = contracted(
      "  %4 = f32 mul %0 %1\n"
      "  %5 = f32 mul %0 %2\n"
      "  %6 = f32 mul %0 %3\n"
      "  %7 = f32 add %4 %5\n"
      "  %8 = f32 add %5 %6\n"
      "  store one %7\n"
      "  store two %8\n");
  EXPECT_EQ(result,
            "  %0 = f32 input a\n"
            "  %1 = f32 input b\n"
            "  %2 = f32 input c\n"
            "  %3 = f32 input d\n"
            "  %4 = f32 mul %0 %2\n"
            "  %5 = f32 fma %0 %1 %4\n"
            "  %6 = f32 fma %0 %3 %4\n"
            "  store one %5\n"
            "  store two %6\n");
}

TEST(Contract, RoundsOnce) {
  Recorder recorder;
  const Float a(recorder.input("a", Scalar::f32));
  const Float b(recorder.input("b", Scalar::f32));
  const Float c(recorder.input("c", Scalar::f32));
  const std::vector<SliceOutput> outputs{{"out", (c - a * b).ref()}};
  const auto kernel = make_interpreter(contract(slice(recorder.program(), "t", outputs)));
  const float x = 1.0f + 0x1p-12f;
  const std::vector<float> as{x}, bs{x}, cs{1.0f + 0x1p-11f};
  const void* inputs[] = {cs.data(), as.data(), bs.data()};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string& name = kernel->program().inputs[k].name;
    inputs[k] = name == "a" ? as.data() : name == "b" ? bs.data() : cs.data();
  }
  float out = 0.0f;
  void* stores[] = {&out};
  kernel->run({.inputs = inputs, .outputs = stores, .count = 1});
  EXPECT_EQ(out, -0x1p-24f);  // The product rounded by itself would give 0.
}

/// A polynomial of moderate values with shared parts, all signs and sums.
Program random_polynomial(std::uint64_t seed) {
  Random random(seed);
  Recorder recorder;
  std::vector<Float> values;
  for (const char* name : {"a", "b", "c", "d"}) {
    values.emplace_back(recorder.input(name, Scalar::f32));
  }
  values.emplace_back(recorder.parameter("p", Scalar::f32, 0x3f400000u));
  const auto body = [](Float x, Float y) { return 0.25f - x * y - (-y) * x * 0.5f; };
  for (int k = 0; k < 30; ++k) {
    const Float x = random.pick(values);
    const Float y = random.pick(values);
    switch (random.below(8)) {
      case 0: values.push_back(x + y); break;
      case 1: values.push_back(x - y); break;
      case 2: values.push_back(-x); break;
      case 3: values.push_back(outline<Float>(recorder, "f", body, x, y)); break;
      case 4: values.push_back(if_any(x < y, x, [&] { return x - y * x; })); break;
      case 5: values.push_back(x * random.pick(values) + y * random.pick(values)); break;
      default: values.push_back(x * y * 0.5f); break;
    }
  }
  std::vector<SliceOutput> outputs;
  for (std::size_t k = values.size() - 8; k < values.size(); ++k) {
    outputs.push_back({fmt::format("out.{}", k), values[k].ref()});
  }
  return slice(recorder.program(), "polynomial", outputs);
}

std::vector<double> evaluate(const Program& program, std::uint64_t seed) {
  const auto kernel = make_reference(program);
  std::vector<float> values;
  for (const Channel& channel : program.inputs) {
    Random random(seed + static_cast<unsigned char>(channel.name[0]));
    values.push_back(static_cast<float>(random.below(1u << 20)) * 0x1p-20f - 0.5f);
  }
  std::vector<const void*> inputs;
  for (const float& value : values) inputs.push_back(&value);
  std::vector<double> out(program.outputs.size());
  std::vector<void*> outputs;
  for (double& value : out) outputs.push_back(&value);
  std::vector<std::uint32_t> parameters;
  for (const ParameterSlot& slot : program.parameters) parameters.push_back(slot.value);
  kernel->run_double({.inputs = inputs.data(),
                      .outputs = outputs.data(),
                      .parameters = parameters.data(),
                      .count = 1});
  return out;
}

TEST(Contract, KeepsEveryValueToRounding) {
  std::size_t fused = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Program before = random_polynomial(seed);
    const Program after = contract(before);
    ASSERT_EQ(verify(after), "");
    fused += count(after, Op::fma);
    const std::vector<double> expected = evaluate(before, seed);
    const std::vector<double> found = evaluate(after, seed);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(found[k], expected[k], 1e-12 * (1.0 + std::abs(expected[k])))
          << seed << "\n"
          << to_string(before) << to_string(after);
    }
    EXPECT_LE(count(after, Op::mul) + count(after, Op::fma),
              count(before, Op::mul) + count(before, Op::add) + count(before, Op::sub));
  }
  EXPECT_GT(fused, 500u);
}

/// The same Program recorded in another order: between two instructions of its structure any
/// order that has operands first.
Program reordered(const Program& program, std::uint64_t seed) {
  Random random(seed);
  Program result = program;
  for (Function& function : result.functions) {
    const std::vector<Instruction> before = function.code;
    const auto stays = [&](ValueId id) {
      const Op op = before[id].op;
      return is_structural(op) || op == Op::result || op == Op::argument || op == Op::call ||
             op == Op::texture_call;
    };
    std::vector<ValueId> order;  // Old ids in the new order.
    std::vector<ValueId> place(before.size(), no_value);
    const auto put = [&](ValueId id) {
      place[id] = static_cast<ValueId>(order.size());
      order.push_back(id);
    };
    for (ValueId begin = 0; begin < before.size();) {
      ValueId end = begin;
      while (end < before.size() && !stays(end)) ++end;
      std::vector<ValueId> waiting(end - begin);
      std::iota(waiting.begin(), waiting.end(), begin);
      while (!waiting.empty()) {
        const auto at = waiting.begin() + random.below(static_cast<std::uint32_t>(waiting.size()));
        const std::span<const ValueId> operands = function.operands(before[*at]);
        const bool is_ready = std::ranges::all_of(
            operands, [&](ValueId operand) { return place[operand] != no_value; });
        if (!is_ready) continue;
        put(*at);
        waiting.erase(at);
      }
      if (end < before.size()) put(end);
      begin = end + 1;
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      Instruction& instruction = function.code[i] = before[order[i]];
      for (std::size_t k = 0; k < instruction.count; ++k) {
        instruction.operands[k] = place[instruction.operands[k]];
      }
      const bool commutes = info(instruction.op).commutes;
      if (commutes && instruction.operands[1] < instruction.operands[0]) {
        std::swap(instruction.operands[0], instruction.operands[1]);
      }
    }
    for (ValueId& operand : function.pool) operand = place[operand];
  }
  return result;
}

/// Compilers evaluate the operands of a node's body in different orders.
TEST(Contract, GivesTheSameBitsInWhateverOrderAProgramWasRecorded) {
  int reorderings = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Program program = random_polynomial(seed);
    const Program other = reordered(program, seed);
    ASSERT_EQ(verify(other), "") << seed;
    const Program first = contract(program);
    const Program second = contract(other);
    reorderings += to_string(first) != to_string(second);
    EXPECT_EQ(evaluate(first, seed), evaluate(second, seed)) << seed;
  }
  EXPECT_GT(reorderings, 200);

  // Every kind of instruction.
  std::vector<std::uint32_t> points(19);
  std::iota(points.begin(), points.end(), 0u);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Program program = random_program(seed);
    const Program first = contract(program);
    const Program second = contract(reordered(program, seed));
    EXPECT_EQ(RandomBatch(first, seed, points).run(*make_interpreter(first), 0, points.size()),
              RandomBatch(second, seed, points).run(*make_interpreter(second), 0, points.size()))
        << seed;
  }
}

TEST(Contract, IsDeterministicAndLeavesNothingToDo) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Program program = seed % 2 == 0 ? random_polynomial(seed) : random_program(seed);
    const Program once = contract(program);
    EXPECT_EQ(verify(once), "");
    EXPECT_EQ(to_string(contract(program)), to_string(once));
    EXPECT_EQ(to_string(contract(once)), to_string(once));
    Program forced = program;
    mark_varying(forced, true);
    EXPECT_EQ(to_string(contract(forced)), to_string(once));
  }
}

}  // namespace
}  // namespace nacre
