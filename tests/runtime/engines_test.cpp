#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/fold.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/reference/reference.h"
#include "runtime/value/control.h"

namespace nacre {
namespace {

std::vector<float> run(const Kernel& kernel, const std::vector<std::vector<float>>& inputs) {
  std::vector<const void*> in;
  for (const auto& channel : inputs) in.push_back(channel.data());
  std::vector<float> out(inputs.front().size());
  std::vector<void*> outs{out.data()};
  std::vector<std::uint32_t> slots;
  for (const ParameterSlot& slot : kernel.program().parameters) slots.push_back(slot.value);
  kernel.run({.inputs = in.data(),
              .outputs = outs.data(),
              .parameters = slots.data(),
              .count = inputs.front().size()});
  return out;
}

Program single(const Recorder& recorder, Ref value) {
  const std::vector<SliceOutput> outputs{{"out", value}};
  return slice(recorder.program(), "test", outputs);
}

std::vector<std::uint32_t> edge_bits() {
  return {0x00000000u, 0x80000000u, 0x00000001u, 0x807fffffu, 0x00800000u, 0x80800000u,
          0x3f800000u, 0xbf800000u, 0x3f000000u, 0xbf000000u, 0x3fc00000u, 0x40200000u,
          0x4effffffu, 0x4f000000u, 0xcf000000u, 0xcf000001u, 0x7f7fffffu, 0xff7fffffu,
          0x7f800000u, 0xff800000u, 0x7fc00000u, 0xffc00001u, 0x7f800001u, 0x4b000001u,
          0x4b7fffffu, 0x3effffffu, 0x33800000u, 0x0da24260u, 0x5e800000u};
}

/// Every operation over all pairs of edge values: the interpreter's vectors
/// against the scalar statement of the meaning in fold().
TEST(Interpreter, AgreesWithScalarMeaningOnEdges) {
  const std::vector<std::uint32_t> edges = edge_bits();
  std::vector<float> a;
  std::vector<float> b;
  for (const std::uint32_t x : edges) {
    for (const std::uint32_t y : edges) {
      a.push_back(std::bit_cast<float>(x));
      b.push_back(std::bit_cast<float>(y));
    }
  }
  for (int number = 0; number < op_count; ++number) {
    const Op op = static_cast<Op>(number);
    const std::string_view operands = info(op).operands;
    if (is_structural(op) || is_transcendental(op) || operands.empty() || operands == "*" ||
        operands.size() > 2 || op == Op::table || op == Op::fitted || op == Op::texel ||
        op == Op::keep || op == Op::ddx || op == Op::stand_in || opens_region(op)) {
      continue;
    }
    Recorder recorder;
    std::vector<Ref> refs;
    const char* names[] = {"a", "b"};
    for (std::size_t k = 0; k < operands.size(); ++k) {
      const Scalar type = operands[k] == 'f'   ? Scalar::f32
                          : operands[k] == 'i' ? Scalar::i32
                                               : Scalar::b1;
      refs.push_back(recorder.input(names[k], type));
    }
    const auto kernel = make_interpreter(single(recorder, recorder.emit(op, refs)));
    std::vector<std::vector<float>> inputs{a};
    if (operands.size() == 2) inputs.push_back(b);
    const std::vector<float> out = run(*kernel, inputs);
    for (std::size_t i = 0; i < a.size(); ++i) {
      std::vector<std::uint32_t> bits{std::bit_cast<std::uint32_t>(a[i]),
                                      std::bit_cast<std::uint32_t>(b[i])};
      for (std::size_t k = 0; k < operands.size(); ++k) {
        if (operands[k] == 'f') bits[k] = flush_denormal(bits[k]);
        if (operands[k] == 'b') bits[k] = bits[k] != 0;
      }
      bits.resize(operands.size());
      EXPECT_EQ(std::bit_cast<std::uint32_t>(out[i]), *fold(op, bits))
          << info(op).name << " " << std::hex << bits[0] << " " << (bits.size() > 1 ? bits[1] : 0);
    }
  }
}

TEST(Interpreter, FmaRoundsOnce) {
  std::vector<std::uint32_t> values = edge_bits();
  values.insert(values.end(), {0x3f800800u, 0xbf801000u, 0x3f801000u, 0xbf801001u});
  std::vector<std::vector<float>> inputs(3);
  for (const std::uint32_t a : values) {
    for (const std::uint32_t b : values) {
      for (const std::uint32_t c : values) {
        inputs[0].push_back(std::bit_cast<float>(flush_denormal(a)));
        inputs[1].push_back(std::bit_cast<float>(flush_denormal(b)));
        inputs[2].push_back(std::bit_cast<float>(flush_denormal(c)));
      }
    }
  }
  Recorder recorder;
  const Float a(recorder.input("a", Scalar::f32));
  const Float b(recorder.input("b", Scalar::f32));
  const Float c(recorder.input("c", Scalar::f32));
  const std::vector<float> out =
      run(*make_interpreter(single(recorder, fma(a, b, c).ref())), inputs);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::vector<std::uint32_t> bits{std::bit_cast<std::uint32_t>(inputs[0][i]),
                                          std::bit_cast<std::uint32_t>(inputs[1][i]),
                                          std::bit_cast<std::uint32_t>(inputs[2][i])};
    ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i]), *fold(Op::fma, bits))
        << inputs[0][i] << " * " << inputs[1][i] << " + " << inputs[2][i];
  }
}

TEST(Engines, LoopStopsEachLaneByItself) {
  // Collatz steps to 1: every lane needs its own number of iterations.
  Recorder recorder;
  const Int start = to_int(Float(recorder.input("x", Scalar::f32)));
  Float2 state{to_float(start), Float(0.0f)};
  state = loop(recorder, start > Int(1), 1000, state, [](Int, Float2& s) {
    const Int v = to_int(s.x);
    const Int next = select((v & Int(1)) == Int(1), v * Int(3) + Int(1), v >> Int(1));
    s.x = to_float(next);
    s.y += 1.0f;
    return next > Int(1);
  });
  const Program program = single(recorder, state.y.ref());
  const std::vector<float> x{1, 2, 3, 6, 7, 9, 27, 97};
  const std::vector<float> expected{0, 1, 7, 8, 16, 19, 111, 118};  // OEIS A006577
  EXPECT_EQ(run(*make_interpreter(program), {x}), expected);
  EXPECT_EQ(run(*make_reference(program), {x}), expected);
}

TEST(Engines, LoopStartsFromALiteral) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float2 start{Float(5.0f), x};
  const Float2 end = loop(recorder, x > 0.0f, 3, start, [](Int, Float2& s) {
    s.x = s.x * 2.0f;
    s.y = s.y - 1.0f;
    return s.y > 0.0f;
  });
  const Program program = single(recorder, end.x.ref());
  const std::vector<float> xs{-1, 1, 2, 9};
  const std::vector<float> expected{5, 10, 20, 40};
  EXPECT_EQ(run(*make_interpreter(program), {xs}), expected);
  EXPECT_EQ(run(*make_reference(program), {xs}), expected);
}

TEST(Engines, OutlinedFunctionIsRecordedOnceAndCalledTwice) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const auto body = [](Float v, Float w) { return Float2{v * w, v + w}; };
  const Float2 once = outline<Float2>(recorder, "pair", body, x, x + 1.0f);
  const Float2 twice = outline<Float2>(recorder, "pair", body, once.x, once.y);
  const Program program = single(recorder, (twice.x - twice.y).ref());
  EXPECT_EQ(program.functions.size(), 2u);
  const std::vector<float> xs{0, 1, 2, 3, -4};
  std::vector<float> expected;
  for (const float v : xs) {
    const float p = v * (v + 1);
    const float s = v + (v + 1);
    expected.push_back(p * s - (p + s));
  }
  EXPECT_EQ(run(*make_interpreter(program), {xs}), expected);
  EXPECT_EQ(run(*make_reference(program), {xs}), expected);
}

TEST(Engines, SkippedRegionLeavesOtherLanes) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float inner = if_any(x > Float(0.0f), Float(-1.0f), [&] {
    return if_any(x > Float(2.0f), x * 10.0f, [&] { return x * 100.0f; });
  });
  const Program program = single(recorder, inner.ref());
  const std::vector<float> mixed{-1, 1, 3, 2};
  EXPECT_EQ(run(*make_interpreter(program), {mixed}), (std::vector<float>{-1, 10, 300, 20}));
  const std::vector<float> none(100, -3.0f);
  EXPECT_EQ(run(*make_interpreter(program), {none}), std::vector<float>(100, -1.0f));
}

}  // namespace
}  // namespace nacre
