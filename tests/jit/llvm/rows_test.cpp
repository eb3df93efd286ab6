// Look-ups along one axis, whose others have one place in all lanes, come of rows made once a call.

#include "jit/llvm/rows.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"
#include "runtime/value/vector.h"
#include "tests/jit/llvm/engine.h"
#include "tests/support/random.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr int quantities = 2, rows = 5, planes = 4;

struct Cell {
  Int first;
  Float fraction;
};
Cell cell(Float at, int nodes) {
  const Float place = saturate(at) * Float(static_cast<float>(nodes - 1));
  const Float first = min(floor(place), Float(static_cast<float>(nodes - 2)));
  return {to_int(first), place - first};
}

/// Both quantities of a table of three axes at (x, p, q).
Float2 look_up(Recorder& recorder, const std::vector<float>& values, int nodes, Float x, Float p,
               Float q) {
  const std::uint32_t table = recorder.table("table", values);
  const Cell of_x = cell(x, nodes), of_p = cell(p, rows), of_q = cell(q, planes);
  const Int base = of_x.first * Int(quantities) + of_p.first * Int(quantities * nodes) +
                   of_q.first * Int(quantities * nodes * rows);
  const auto entry = [&](int offset) {
    const Ref index = (base + Int(offset)).ref();
    return Float(recorder.emit(Op::table, std::span(&index, 1), table));
  };
  const auto at = [&](int quantity) {
    const auto along_x = [&](int node) {
      const auto along_p = [&](int plane) {
        const int corner = quantity + node * quantities + plane * quantities * nodes * rows;
        return lerp(entry(corner), entry(corner + quantities * nodes), of_p.fraction);
      };
      return lerp(along_p(0), along_p(1), of_q.fraction);
    };
    return lerp(along_x(0), along_x(1), of_x.fraction);
  };
  return {at(0), at(1)};
}

std::vector<float> table_values(int nodes) {
  Random random(7);
  std::vector<float> values;
  for (int k = 0; k < quantities * nodes * rows * planes; ++k) {
    values.push_back(static_cast<float>(random.word() >> 40) * 0x1p-24f);
  }
  return values;
}

/// In a region that not all lanes need, of a `p` that is a parameter or a channel.
Program look_up_where_positive(int nodes, float p_value, bool p_varies) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float p =
      p_varies ? input(recorder, "p")
               : Float(recorder.parameter("p", Scalar::f32, std::bit_cast<std::uint32_t>(p_value)));
  const Float q(recorder.parameter("q", Scalar::f32, std::bit_cast<std::uint32_t>(0.7f)));
  const Float2 found = if_any(!(x < 0.0f), Float2{-1.0f, -1.0f}, [&] {
    return look_up(recorder, table_values(nodes), nodes, x, p * p, sqrt(q));
  });
  const std::vector<SliceOutput> outputs{{"a", found.x.ref()}, {"b", found.y.ref()}};
  return slice(recorder.program(), "look_up", outputs);
}

std::vector<float> places(std::size_t count) {
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<float> x{0.0f, 1.0f, -0.0f, 1e-30f, -3.0f, 7.0f, inf, -inf, std::nanf("")};
  Random random(3);
  while (x.size() < count) x.push_back(static_cast<float>(random.word() >> 40) * 0x1p-24f);
  x.resize(count);
  return x;
}

codegen::Rows rows_of(const Program& program) { return codegen::find_rows(program.entry(), 16); }

TEST(Rows, AreFoundWhereOneAxisVaries) {
  const codegen::Rows found = rows_of(look_up_where_positive(24, 0.3f, false));
  ASSERT_EQ(found.rows.size(), 2u);  // A quantity each, which both nodes read.
  EXPECT_EQ(found.rows[0].count, 24u);
  ASSERT_EQ(found.groups.size(), 1u);
  EXPECT_EQ(found.groups.begin()->second.reads.size(), 4u);
  EXPECT_TRUE(rows_of(look_up_where_positive(24, 0.3f, true)).rows.empty());
}

/// Two tables of one index, whose nodes lie other ways apart: a node further is no place further.
/// Whether there is a row where a look-up is at a coordinate that is never above 1.
bool has_row(Float (*coordinate)(Float x, Float y)) {
  constexpr int nodes = 8;
  Recorder recorder;
  const Float x = input(recorder, "x"), y = input(recorder, "y");
  const Float p(recorder.parameter("p", Scalar::f32, 0));
  const std::uint32_t table = recorder.table("table", table_values(nodes));
  const Float place = coordinate(x, y) * Float(nodes - 1.0f);
  const Float first = min(floor(place), Float(nodes - 2.0f));
  const Int base = to_int(first) + to_int(p) * Int(nodes);
  const auto entry = [&](int offset) {
    const Ref index = (base + Int(offset)).ref();
    return Float(recorder.emit(Op::table, std::span(&index, 1), table));
  };
  const Float found =
      lerp(lerp(entry(0), entry(nodes), p), lerp(entry(1), entry(nodes + 1), p), place - first);
  Program program = slice(recorder.program(), "rows", std::vector<SliceOutput>{{"z", found.ref()}});
  mark_varying(program);
  return !rows_of(program).rows.empty();
}

// Clamps that change nothing are left out of kernels, so what keeps an index from being negative is
// read off what it is computed of.
TEST(Rows, AreFoundWhereNoClampSaysThatAnIndexIsNotNegative) {
  EXPECT_TRUE(has_row([](Float x, Float) { return min(max(x, 0.0f), 1.0f); }));
  EXPECT_TRUE(has_row([](Float x, Float) { return min(abs(x), 1.0f); }));
  EXPECT_TRUE(has_row([](Float x, Float) { return min(sqrt(x), 1.0f); }));
  EXPECT_TRUE(
      has_row([](Float x, Float y) { return min(abs(x) / max(abs(x) + abs(y), 1e-3f), 1.0f); }));
  EXPECT_TRUE(
      has_row([](Float x, Float y) { return min(abs(x) / fma(abs(x), abs(y), 0.5f), 1.0f); }));
  EXPECT_TRUE(has_row(
      [](Float x, Float y) { return min(if_any(x < y, abs(x), [&] { return abs(y); }), 1.0f); }));
  EXPECT_FALSE(has_row([](Float x, Float) { return min(x, 1.0f); }));
  // -0 makes -infinity of what it divides.
  EXPECT_FALSE(has_row([](Float x, Float y) { return min(abs(x) / max(y, 0.0f), 1.0f); }));
  EXPECT_FALSE(has_row([](Float x, Float y) { return min(fma(x, abs(y), 0.5f), 1.0f); }));
}

TEST(Rows, OfTablesWithOtherStridesAreApart) {
  Recorder recorder;
  const Cell of_x = cell(input(recorder, "x"), 24);
  const Float p(recorder.parameter("p", Scalar::f32, std::bit_cast<std::uint32_t>(0.3f)));
  const std::uint32_t table = recorder.table("table", table_values(24));
  const auto entry = [&](int stride, int offset) {
    const Ref index = (of_x.first * Int(stride) + Int(offset)).ref();
    return Float(recorder.emit(Op::table, std::span(&index, 1), table));
  };
  const auto both = [&](int offset) {
    const Float threes = entry(3, offset), twos = entry(2, offset + 1);
    return fma(threes, p, twos);
  };
  const std::vector<SliceOutput> outputs{{"a", lerp(both(0), both(2), of_x.fraction).ref()}};
  const Program program = slice(recorder.program(), "look_up", outputs);
  EXPECT_EQ(rows_of(program).rows.size(), 2u);
  const auto kernel = compiled(program, {});
  ASSERT_NE(kernel, nullptr);
  Columns in{{"x", places(8 * rows_of(program).least_points)}};
  for (float& x : in["x"]) x = std::isfinite(x) ? x : 0.5f;
  EXPECT_EQ(run(*kernel, in).at("a"), run(*make_interpreter(program), in).at("a"));
}

TEST(Rows, GiveTheSameBitsOnEveryCpu) {
  for (const int nodes : {3, 24, 40, 150}) {
    for (const float p : {0.31f, std::nanf("")}) {
      const Program program = look_up_where_positive(nodes, p, false);
      const auto least = rows_of(program).least_points;
      ASSERT_GT(least, 0u);
      const auto interpreter = make_interpreter(program);
      for (const int lanes : {4, 8, 16}) {
        for (const char* cpu : {"", "x86-64", "haswell"}) {
          if (std::string_view(cpu) == "haswell" && __builtin_cpu_supports("avx2") == 0) continue;
          const Target target = *cpu == '\0' ? Target::host() : Target::named(cpu);
          const auto kernel = compiled(program, {.lanes = lanes, .target = target});
          ASSERT_NE(kernel, nullptr);
          // With rows and without.
          for (const std::size_t count : {std::size_t{5}, least / 4, 8 * least + 3}) {
            const Columns in{{"x", places(count)}};
            const Columns expected = run(*interpreter, in), found = run(*kernel, in);
            for (const char* name : {"a", "b"}) {
              for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(std::bit_cast<std::uint32_t>(found.at(name)[i]),
                          std::bit_cast<std::uint32_t>(expected.at(name)[i]))
                    << nodes << " nodes, p " << p << ", W = " << lanes << ", " << cpu << ", x "
                    << in.at("x")[i];
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace nacre
