#include "jit/passes/derive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "jit/passes/footprint.h"
#include "runtime/interpreter/interpreter.h"
#include "tests/jit/passes/derivative_check.h"
#include "tests/support/random_program.h"

namespace nacre {
namespace {

/// Of the input channels, sorted.
std::vector<std::string> names(const Program& program) {
  std::vector<std::string> list;
  for (const Channel& channel : program.inputs) list.push_back(channel.name);
  std::ranges::sort(list);
  return list;
}

Float input(Recorder& recorder, const char* name) {
  return Float(recorder.input(name, Scalar::f32));
}

std::size_t count(const Program& program, Op op) {
  std::size_t found = 0;
  for (const Function& function : program.functions) {
    found += static_cast<std::size_t>(
        std::ranges::count(function.code, op, [](const Instruction& i) { return i.op; }));
  }
  return found;
}

TEST(Footprint, NamesDerivativeChannels) {
  EXPECT_EQ(derivative_channel("P.x", 0), "dPdx.x");
  EXPECT_EQ(derivative_channel("Po.z", 1), "dPody.z");
  EXPECT_EQ(derivative_channel("uv12.y", 1), "duv12dy.y");
  EXPECT_EQ(derivative_channel("N.x", 0), std::nullopt);
  EXPECT_EQ(derivative_channel("state.3", 0), std::nullopt);
  EXPECT_EQ(derivative_channel("dPdx.x", 0), std::nullopt);
  EXPECT_EQ(derivative_channel("uv.x", 0), std::nullopt);
  const std::array<std::string_view, 2> more{"N", "heat"};
  EXPECT_EQ(derivative_channel("N.y", 0, more), "dNdx.y");
  EXPECT_EQ(derivative_channel("heat", 1, more), "dheatdy");
}

TEST(Derive, AsksOnlyForTheChannelsItNeeds) {
  Recorder recorder;
  const Float p = input(recorder, "P.x");
  const Float unused = input(recorder, "P.y");
  const std::vector<SliceOutput> outputs{{"out", (footprint_derivative(p * p, 1) + unused).ref()}};
  const Program derived = derive(slice(recorder.program(), "test", outputs));
  EXPECT_EQ(names(derived), (std::vector<std::string>{"P.x", "P.y", "dPdy.x"}));
  EXPECT_EQ(count(derived, Op::ddx), 0u);
}

TEST(Derive, LeavesOutThePrimalWhereOnlyTheSlopeCounts) {
  Recorder recorder;
  const Float u = input(recorder, "uv0.x");
  const std::vector<SliceOutput> outputs{{"out", footprint_derivative(3.0f * u + 1.0f, 0).ref()}};
  EXPECT_EQ(names(derive(slice(recorder.program(), "test", outputs))),
            std::vector<std::string>{"duv0dx.x"});
}

TEST(Derive, OfAChannelIsTheChannelItself) {
  Recorder recorder;
  const std::vector<SliceOutput> outputs{
      {"out", footprint_derivative(input(recorder, "uv0.x"), 0).ref()}};
  EXPECT_EQ(to_string(derive(slice(recorder.program(), "test", outputs))),
            "program test\n"
            "entry\n"
            "  %0 = f32 input duv0dx.x\n"
            "  store out %0\n");
}

TEST(Derive, UniformAndUndeclaredInputsAreConstant) {
  Recorder recorder;
  const Float n = input(recorder, "N.x");
  const Float time(recorder.parameter("time", Scalar::f32, 0));
  const std::vector<SliceOutput> outputs{{"out", footprint_derivative(n * time, 0).ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  EXPECT_TRUE(derive(program).inputs.empty());
  const std::array<std::string_view, 1> more{"N"};
  EXPECT_EQ(names(derive(program, more)), std::vector<std::string>{"dNdx.x"});
}

TEST(Derive, ProgramWithoutDerivativesIsUnchanged) {
  const Program program = record_body([](Recorder&, Float u, Float v) { return sin(u) * v; });
  EXPECT_EQ(to_string(derive(program)), to_string(program));
}

TEST(Derive, ThroughIfAny) {
  expect_derivative([](Recorder&, Float u, Float v) {
    const Float2 r = if_any(u < v, Float2{u * 2.0f, v}, [&] {
      const Float inner = if_any(u * u < v, u, [&] { return u * v; });
      return Float2{sin(inner), Float(1.0f)};
    });
    return r.x * r.y;
  });
}

TEST(Derive, InsideARegion) {
  // The ddx stands in the region; its tangents are of values inside and outside.
  const auto body = [](Float u, Float v) { return u * v * v; };
  const auto plain =
      make_reference(derivative_of([&](Recorder&, Float u, Float v) { return body(u, v); }, 1));
  const auto inside = make_reference(derive(record_body([&](Recorder&, Float u, Float v) {
    const Float w = u * v;
    return if_any(u > 0.0f, Float(0.0f), [&] { return footprint_derivative(w * v, 1); });
  })));
  for (const FootprintPoint& p : generic_points()) {
    EXPECT_DOUBLE_EQ(evaluate(*inside, p), evaluate(*plain, p));
  }
}

TEST(Derive, CarriesTangentsAlongLoops) {
  expect_derivative([](Recorder& recorder, Float u, Float v) {
    // Stops at different iterations at different points; the second carry
    // starts without a tangent and gets one on the way.
    const Float2 r = loop(recorder, Bool(true), 6, Float2{u, Float(1.0f)}, [&](Int i, Float2& s) {
      s.x = s.x * 1.25f + v * to_float(i);
      s.y = s.y * cos(s.x);
      return s.x < 4.0f;
    });
    return r.x + r.y;
  });
}

TEST(Derive, CarriesNoTangentThatNobodyNeeds) {
  const Body body = [](Recorder& recorder, Float u, Float v) {
    const Float3 r = loop(recorder, Bool(true), 4, Float3(u, v, u), [&](Int, Float3& s) {
      s = {s.x * s.x, s.y + u, s.z + 1.0f};
      return s.z < 3.0f;
    });
    return footprint_derivative(r.x, 0) + r.y;
  };
  const Program before = record_body(body);
  const Program after = derive(before);
  EXPECT_EQ(count(after, Op::carry), count(before, Op::carry) + 1);
  EXPECT_EQ(names(after), (std::vector<std::string>{"duv0dx.x", "uv0.x", "uv0.y"}));
}

TEST(Derive, ThroughNestedLoopsAndRegions) {
  expect_derivative([](Recorder& recorder, Float u, Float v) {
    const Float2 r = loop(recorder, u > 0.0f, 3, Float2{u, v}, [&](Int i, Float2& s) {
      const Float2 inner = loop(recorder, Bool(true), 2, s, [&](Int, Float2& t) {
        t = {t.x * v + s.y, sin(t.x)};
        return Bool(true);
      });
      s.x = if_any(inner.x < 1.0f, inner.y, [&] { return inner.x * inner.y; });
      s.y = inner.x;
      return i < Int(2);
    });
    return r.x * r.y;
  });
}

/// Worley-like: two results, of which one is piecewise constant.
Float2 cell_distance(Float x, Float y, Float scale) {
  const Float a = fract(x * scale) - 0.25f;
  const Float b = y - 0.5f;
  return {sqrt(a * a + b * b + 0.125f), floor(x * scale)};
}

TEST(Derive, ThroughOutlinedFunctions) {
  expect_derivative([](Recorder& recorder, Float u, Float v) {
    const Float2 once = outline<Float2>(recorder, "cell", cell_distance, u, v, Float(3.0f));
    const Float2 twice = outline<Float2>(recorder, "cell", cell_distance, once.x, u, Float(3.0f));
    return once.x * twice.x + once.y;
  });
}

TEST(Derive, ThroughFunctionsThatCallFunctions) {
  expect_derivative([](Recorder& recorder, Float u, Float v) {
    const auto inner = [](Float x, Float y) { return exp(x * y); };
    const auto outer = [&](Float x, Float y) {
      const Float a = outline<Float>(recorder, "inner", inner, x, y);
      return a + outline<Float>(recorder, "inner", inner, y, Float(0.5f) * x);
    };
    return outline<Float>(recorder, "outer", outer, u, v) * v;
  });
}

TEST(Derive, OneVariantForEachSetOfTangents) {
  const Program derived = derive(record_body([](Recorder& recorder, Float u, Float v) {
    const auto body = [](Float x, Float y) { return sin(x) * y; };
    const auto call = [&](Float x, Float y) { return outline<Float>(recorder, "f", body, x, y); };
    const Float one = call(u, floor(v));      // A tangent in x.
    const Float two = call(v * u, floor(u));  // The same variant.
    const Float three = call(floor(u), v);    // A tangent in y.
    const Float four = call(u + 1.0f, v);     // No derivative of it: the plain one.
    return footprint_derivative(one + two + three, 0) + four;
  }));
  EXPECT_EQ(derived.functions.size(), 4u) << to_string(derived);
}

TEST(Derive, InsideAnOutlinedFunction) {
  // The function asks for the derivative of its argument; the caller supplies it.
  const auto edge = [](Float x, Float width) {
    const Float slope = abs(footprint_derivative(x, 0)) + abs(footprint_derivative(x, 1));
    return x / (slope + width);
  };
  const auto inlined = make_reference(derive(
      record_body([&](Recorder&, Float u, Float v) { return edge(u * v, v) + edge(v, u); })));
  const auto outlined =
      make_reference(derive(record_body([&](Recorder& recorder, Float u, Float v) {
        return outline<Float>(recorder, "edge", edge, u * v, v) +
               outline<Float>(recorder, "edge", edge, v, u);
      })));
  EXPECT_EQ(count(outlined->program(), Op::ddx), 0u);
  for (const FootprintPoint& p : generic_points()) {
    EXPECT_DOUBLE_EQ(evaluate(*outlined, p), evaluate(*inlined, p));
  }
}

// floor(3 u) stands in for u^2 v: its value, and the other's derivatives of any order, through
// products and functions.
TEST(Derive, WhatStandsInHasTheDerivativesOfTheOther) {
  const auto drawn = [](Float u, Float v) { return stand_in(floor(3.0f * u), u * u * v); };
  const Program value =
      derive(record_body([&](Recorder&, Float u, Float v) { return drawn(u, v) * 2.0f; }));
  EXPECT_EQ(count(value, Op::stand_in), 0u);
  EXPECT_EQ(count(value, Op::floor), 1u);
  EXPECT_LE(value.entry().code.size(), 8u);  // Nothing of the other.
  const auto first = make_reference(derive(record_body([&](Recorder& recorder, Float u, Float v) {
    return footprint_derivative(outline<Float>(recorder, "drawn", drawn, u, v) * v, 0);
  })));
  const auto second = make_reference(derive(record_body([&](Recorder&, Float u, Float v) {
    return footprint_derivative(footprint_derivative(drawn(u, v), 0), 1);
  })));
  EXPECT_EQ(count(first->program(), Op::stand_in) + count(second->program(), Op::stand_in), 0u);
  for (const FootprintPoint& p : generic_points()) {
    const double u = static_cast<double>(p.u), v = static_cast<double>(p.v);
    const double ux = static_cast<double>(p.dudx), uy = static_cast<double>(p.dudy);
    const double vx = static_cast<double>(p.dvdx), vy = static_cast<double>(p.dvdy);
    const double slope = 2 * u * v * ux + u * u * vx;
    EXPECT_NEAR(evaluate(*first, p), slope * v + std::floor(3 * u) * vx, 1e-9);
    EXPECT_NEAR(evaluate(*second, p), 2 * v * ux * uy + 2 * u * (ux * vy + uy * vx), 1e-9);
  }
}

TEST(Derive, SecondDerivatives) {
  // d2/dxdy of u^2 v: 2 v ux uy + 2 u (ux vy + uy vx).
  const auto derived = make_reference(derive(record_body([](Recorder&, Float u, Float v) {
    return footprint_derivative(footprint_derivative(u * u * v, 0), 1);
  })));
  EXPECT_EQ(count(derived->program(), Op::ddx), 0u);
  for (const FootprintPoint& p : generic_points()) {
    const double u = static_cast<double>(p.u);
    const double v = static_cast<double>(p.v);
    const double ux = static_cast<double>(p.dudx);
    const double uy = static_cast<double>(p.dudy);
    const double expected =
        2 * v * ux * uy +
        2 * u * (ux * static_cast<double>(p.dvdy) + uy * static_cast<double>(p.dvdx));
    EXPECT_NEAR(evaluate(*derived, p), expected, 1e-13);
  }
}

TEST(Derive, OfAHeightWhoseFilterUsesDerivatives) {
  // A pattern fades out by its own footprint: bump mapping takes the derivative
  // of what holds a derivative, in a function called within that of another.
  const auto filtered = [](Float x, Float y) {
    const Float width = abs(footprint_derivative(x * y, 0)) + 0.5f;
    return sin(x * 7.0f) * exp(-(width * width)) + y;
  };
  expect_derivative([&](Recorder& recorder, Float u, Float v) {
    const Float height = outline<Float>(recorder, "filtered", filtered, u, v);
    return outline<Float>(recorder, "filtered", filtered, height * v, u);
  });
}

TEST(Derive, ThirdOrderIsExactAndDeeperEnds) {
  const auto nest = [](int depth) {
    return derive(record_body([depth](Recorder&, Float u, Float) {
      Float x = u * u * u * u;
      for (int i = 0; i < depth; ++i) x = footprint_derivative(x, 0);
      return x;
    }));
  };
  const auto third = make_reference(nest(3));
  for (const FootprintPoint& p : generic_points()) {
    const double ux = static_cast<double>(p.dudx);
    EXPECT_NEAR(evaluate(*third, p), 24 * static_cast<double>(p.u) * ux * ux * ux, 1e-13);
  }
  const Program fifth = nest(5);
  EXPECT_EQ(count(fifth, Op::ddx), 0u);
  EXPECT_TRUE(fifth.inputs.empty());
}

TEST(Derive, OfALoopThatFeedsItselfTakesTheFeedbackForConstant) {
  const Program derived = derive(record_body([](Recorder& recorder, Float u, Float) {
    const Float2 r = loop(recorder, Bool(true), 3, Float2{u * u, Float(0.0f)}, [](Int, Float2& s) {
      s.x = s.x + footprint_derivative(s.x, 0);
      return Bool(true);
    });
    return r.x;
  }));
  EXPECT_EQ(count(derived, Op::ddx), 0u);
  const auto kernel = make_reference(derived);
  for (const FootprintPoint& p : generic_points()) {
    const double u = static_cast<double>(p.u);
    EXPECT_NEAR(evaluate(*kernel, p), u * u + 3 * 2 * u * static_cast<double>(p.dudx), 1e-13);
  }
}

TEST(Derive, TextureCallsAreConstant) {
  const Program derived = derive(record_body([](Recorder& recorder, Float u, Float v) {
    const std::vector<Ref> operands{Ref::literal(0), u.ref(), v.ref(), u.ref(),
                                    v.ref(),         u.ref(), v.ref()};
    recorder.texture("a.exr");
    const std::vector<Ref> rgba = recorder.texture_call(operands, 0);
    return footprint_derivative(Float(rgba[0]) * u, 0);
  }));
  EXPECT_EQ(verify(derived), "");
  EXPECT_EQ(names(derived), (std::vector<std::string>{"duv0dx.x", "uv0.x", "uv0.y"}));
}

TEST(Derive, PassesKeeps) {
  Recorder recorder;
  const Float u = input(recorder, "uv0.x");
  const Float kept(recorder.keep((u * u).ref()));
  const std::vector<SliceOutput> outputs{{"out", footprint_derivative(kept, 0).ref()}};
  EXPECT_EQ(names(derive(slice(recorder.program(), "test", outputs))),
            (std::vector<std::string>{"duv0dx.x", "uv0.x"}));
  EXPECT_TRUE(derive(slice(recorder.program(), "test", outputs, Keeps::load)).inputs.empty());
}

/// `program` with one output more: the derivative of one of its values.
Program with_derivative_of(Program program, ValueId value, std::uint32_t axis) {
  Function& entry = program.entry();
  const auto derivative = static_cast<ValueId>(entry.code.size());
  entry.code.push_back({.op = Op::ddx,
                        .type = Scalar::f32,
                        .count = 1,
                        .imm = axis,
                        .operands = {value, no_value, no_value}});
  entry.code.push_back({.op = Op::store,
                        .count = 1,
                        .imm = static_cast<std::uint32_t>(program.outputs.size()),
                        .operands = {derivative, no_value, no_value}});
  program.outputs.push_back({"derivative", Scalar::f32});
  return program;
}

TEST(Derive, OfAnyProgramIsFiniteAndLeavesTheRest) {
  // Every float input has a footprint.
  const std::array<std::string_view, 3> more{"in.f320", "in.f321", "in.f322"};
  std::vector<std::uint32_t> order(40);
  std::iota(order.begin(), order.end(), 0u);
  std::size_t not_constant = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Program program = random_program(seed);
    const auto before = RandomBatch(program, seed, order).run(*make_interpreter(program), 0, 40);
    std::vector<ValueId> values = top_level_values(program);
    std::erase_if(values, [&](ValueId id) { return program.entry().code[id].type != Scalar::f32; });
    for (std::size_t k = 0; k < values.size(); k += 5) {
      const Program derived = derive(with_derivative_of(program, values[k], seed % 2), more);
      ASSERT_EQ(verify(derived), "");
      ASSERT_EQ(count(derived, Op::ddx), 0u);
      auto after = RandomBatch(derived, seed, order).run(*make_interpreter(derived), 0, 40);
      for (const std::uint32_t bits : after.back()) {
        const Instruction& stored = derived.entry().code[derived.entry().code.back().operands[0]];
        if (stored.op == Op::input) continue;  // A channel is what the host says.
        ASSERT_TRUE(std::isfinite(std::bit_cast<float>(bits))) << seed << "\n"
                                                               << to_string(derived);
        not_constant += bits != 0 ? 1u : 0u;
      }
      after.pop_back();
      ASSERT_EQ(after, before) << seed << "\n" << to_string(derived);
    }
  }
  EXPECT_GT(not_constant, 1000u);
}

}  // namespace
}  // namespace nacre
