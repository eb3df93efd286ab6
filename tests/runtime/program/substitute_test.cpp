#include "runtime/program/substitute.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "runtime/value/control.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

struct Pair {
  Float first, second;
};
template <class F>
void visit(Pair& pair, F&& f) {
  f(pair.first), f(pair.second);
}

/// Of x and y by everything that a recording has: branches in loops, calls, tables, what is kept.
Float everything(Recorder& recorder, Float x, Float y) {
  const std::array<float, 4> values{2.0f, 3.0f, 5.0f, 7.0f};
  const std::uint32_t table = recorder.table("primes", values);
  const auto prime = [&](Float at) {
    const std::array<Ref, 1> operand{to_int(at).ref()};
    return Float(recorder.emit(Op::table, operand, table));
  };
  const Float sum =
      outline<Float>(recorder, "sum", [](Float a, Float b) { return sqrt(a * a + b * b); }, x, y);
  const Float kept(recorder.keep((sum + prime(y)).ref()));
  const Pair looped = loop(recorder, y > 0.0f, 5, Pair{kept, x}, [&](Int count, Pair& pair) {
    const Float more = if_any(pair.second > 1.0f, pair.first, [&] {
      const Float of_both = outline<Float>(
          recorder, "product", [](Float a, Float b) { return a * b; }, pair.first, y);
      return if_any(of_both > 4.0f, of_both, [&] { return of_both + prime(x); });
    });
    pair = {more, pair.second + 0.25f};
    return to_float(count) < y;
  });
  return looped.first - 2.0f * looped.second + kept;
}

Columns points() {
  Columns columns;
  for (int i = 0; i < 100; ++i) {
    columns["x"].push_back(0.37f * static_cast<float>(i % 10) - 1.0f);
    columns["y"].push_back(0.45f * static_cast<float>(i / 10) - 0.5f);
  }
  return columns;
}

Columns results(Recorder& recorder, Ref value) {
  const std::array outputs{SliceOutput{"out", value}};
  const Program program = slice(recorder.program(), "test", outputs);
  EXPECT_EQ(verify(program), "");
  return run_double(*make_reference(program), points()).empty()
             ? Columns()
             : run(*make_reference(program), points());
}

// What another value gives where it is put for a channel is what a recording of that one gives.
TEST(Substitute, ValuesAreThoseOfAnotherRecording) {
  const auto other = [](Float x, Float y) { return y * 1.5f - x + 0.125f; };
  for (const std::string channel : {"x", "y"}) {
    Recorder recorder;
    const Float x = input(recorder, "x"), y = input(recorder, "y");
    const Float value = everything(recorder, x, y);
    const Ref by = other(x, y).ref();
    const std::vector<Ref> found = substitute(
        recorder, std::array{value.ref(), Ref::literal(2.0f)},
        [&](std::string_view name) { return name == channel ? std::optional(by) : std::nullopt; });
    EXPECT_TRUE(found[1].is_constant());
    Recorder plain;
    const Float px = input(plain, "x"), py = input(plain, "y");
    const Float expected = channel == "x" ? everything(plain, other(px, py), py)
                                          : everything(plain, px, other(px, py));
    const Columns a = results(recorder, found[0]), b = results(plain, expected.ref());
    EXPECT_EQ(a.at("out"), b.at("out")) << channel;
    EXPECT_NE(a.at("out"), results(recorder, value.ref()).at("out")) << channel;
  }
}

TEST(Substitute, WhatDependsOnNoneIsShared) {
  Recorder recorder;
  const Float x = input(recorder, "x"), y = input(recorder, "y");
  const Float of_x = if_any(x > 0.0f, Float(1.0f), [&] { return sqrt(x); });
  const std::size_t before = recorder.size();
  const Float literal = 3.0f;
  const std::vector<Ref> found =
      substitute(recorder, std::array{of_x.ref(), (of_x + y).ref()}, [&](std::string_view name) {
        return name == "y" ? std::optional(literal.ref()) : std::nullopt;
      });
  EXPECT_EQ(found[0].id, of_x.ref().id);
  // The sum before, the literal and the sum again.
  EXPECT_EQ(recorder.size(), before + 3);
}

}  // namespace
}  // namespace nacre
