#include "runtime/program/parse.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "runtime/program/digest.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"

namespace nacre {
namespace {

Program single(const Recorder& recorder, Ref value) {
  const std::vector<SliceOutput> outputs{{"out", value}};
  return slice(recorder.program(), "a test", outputs);
}

void expect_round_trip(const Program& program) {
  const std::string text = to_string(program);
  Diagnostics diagnostics;
  const std::optional<Program> parsed = parse_program(text, diagnostics);
  ASSERT_TRUE(parsed.has_value()) << diagnostics.to_string() << text;
  EXPECT_EQ(to_string(*parsed), text);
  EXPECT_EQ(digest(*parsed), digest(program)) << text;
  EXPECT_EQ(parsed->parameters, program.parameters);
  for (std::size_t f = 0; f < program.functions.size(); ++f) {
    EXPECT_EQ(parsed->functions[f].code, program.functions[f].code) << text;
  }
}

TEST(Parse, ReadsBackEveryKindOfInstruction) {
  Recorder recorder;
  const Float x(recorder.input("P.x", Scalar::f32));
  const Int n(recorder.input("id", Scalar::i32));
  const Bool flag(recorder.parameter("flag", Scalar::b1, 1));
  const Float live(
      recorder.parameter("SR/base_color.x", Scalar::f32, std::bit_cast<std::uint32_t>(0.1f)));
  const Int count(recorder.parameter("count", Scalar::i32, static_cast<std::uint32_t>(-7)));
  const std::vector<float> values{0.0f, -0.0f, 1e-30f, 0.1f};
  const std::uint32_t table = recorder.table("ramp", values);
  const Ref slot = recorder.texture("a picture.png");
  const Float looked_up(record(Op::table, {n.ref()}, table));
  const std::vector<Ref> rgba = recorder.texture_call(
      std::vector<Ref>{slot, x.ref(), live.ref(), x.ref(), x.ref(), x.ref(), x.ref()}, 5);
  const std::vector<Ref> limited = recorder.texture_call(
      std::vector<Ref>{slot, x.ref(), live.ref(), x.ref(), x.ref(), x.ref(), x.ref(), n.ref()}, 5);
  const Int word(record(Op::texel, {slot, n.ref()}));
  const auto body = [](Float a, Int b) { return Float2{a * to_float(b), a + 1.0f}; };
  const Float2 called = outline<Float2>(recorder, "pair", body, x, count);
  const Float2 looped = loop(recorder, flag, 12, called, [&](Int i, Float2& s) {
    s.x = if_any(s.x < s.y, s.y, [&] { return s.x * looked_up; });
    return i < n;
  });
  const Float kept(recorder.keep((looped.x + Float(rgba[2]) * Float(limited[1])).ref()));
  const Float sum = kept + half_to_float(word) + footprint_derivative(x * x, 1);
  expect_round_trip(single(recorder, sum.ref()));
  expect_round_trip(single(recorder, (sum < live).ref()));
  expect_round_trip(single(recorder, Ref::literal(true)));
}

TEST(Parse, ConstantsKeepTheirBits) {
  for (const std::uint32_t bits :
       {0x00000000u, 0x80000000u, 0x00000001u, 0x807fffffu, 0x00800000u, 0x3dcccccdu, 0x7f7fffffu,
        0x7f800000u, 0xff800000u, 0x7fc00000u, 0xffc00001u, 0x7f800001u, 0x4b7fffffu}) {
    const Recorder recorder;
    expect_round_trip(single(recorder, {nullptr, bits, Scalar::f32}));
    expect_round_trip(single(recorder, {nullptr, bits, Scalar::i32}));
  }
}

TEST(Parse, FaultsSayWhereTheyAre) {
  struct Case {
    const char* text;
    const char* expected;  ///< Of the diagnostic's text.
  };
  const std::vector<Case> cases{
      {"", "f: error: this is not the text of a program; expected an entry, found the end"},
      {"entry\n  %0 = f32 add %1 %2\n",
       "f:2: error: this is not the text of a program; expected "
       "a value defined before, found %1"},
      {"entry\n  %1 = f32 const 1\n",
       "f:2: error: this is not the text of a program; expected "
       "%0, found %1"},
      {"entry\n  %0 = f32 const one\n",
       "f:2: error: this is not the text of a program; expected "
       "a number, found one"},
      {"entry\n  %0 = f64 const 1\n",
       "f:2: error: this is not the text of a program; expected "
       "an operation, found f64"},
      {"entry\n  %0 = i32 const 4294967296\n",
       "f:2: error: this is not the text of a program; expected an integer, found 4294967296"},
      {"entry\n  %0 = f32 param gain\n",
       "f:2: error: this is not the text of a program; expected "
       "a parameter, found gain"},
      {"  %0 = f32 const 1\n",
       "f:1: error: this is not the text of a program; expected a "
       "function or the entry, found %0"},
      {"function @f.2()\n",
       "f:1: error: this is not the text of a program; expected index 1, "
       "found @f.2()"},
      {"entry\nprogram x\n",
       "f:2: error: this is not the text of a program; expected an "
       "instruction, indented, found program"},
  };
  for (const Case& c : cases) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_program(c.text, diagnostics, "f").has_value());
    ASSERT_EQ(diagnostics.all().size(), 1u) << c.text;
    Diagnostic diagnostic = diagnostics.all().front();
    if (diagnostic.where.line == 0) continue;
    EXPECT_TRUE(diagnostic.to_string().starts_with(c.expected)) << diagnostic.to_string() << "\n"
                                                                << c.expected;
  }
}

TEST(Parse, AnyTextIsSafe) {
  // Every prefix, and every text with one character replaced, of a real one.
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const auto body = [](Float a) { return a * a; };
  const Float called = outline<Float>(recorder, "f", body, x);
  const Float value = if_any(x > 0.0f, called, [&] { return sqrt(x); });
  const std::string text = to_string(single(recorder, value.ref()));
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char c : {'\0', '%', '9', ' ', '\n', '@', '.', '('}) {
      std::string changed = text;
      changed[i] = c;
      Diagnostics diagnostics;
      const auto parsed = parse_program(changed, diagnostics);
      EXPECT_NE(parsed.has_value(), diagnostics.has_errors()) << changed;
    }
    Diagnostics diagnostics;
    parse_program(std::string_view(text).substr(0, i), diagnostics);
  }
}

}  // namespace
}  // namespace nacre
