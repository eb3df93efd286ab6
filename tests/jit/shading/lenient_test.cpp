// What GraphOptions::lenient reads, and as which numbers: those of the shaders that MaterialX
// 1.39.5 generates of the same documents (GLSL; every one of them compiles).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

std::string constant(const std::string& type, const std::string& value) {
  return fmt::format(R"(<constant name="k" type="{0}"><input name="value" type="{0}" value="{1}"/>
      </constant>)",
                     type, value);
}

class Lenient : public ::testing::Test {
 protected:
  static ShadingSystem& system() {
    static const auto made = [] {
      Diagnostics diagnostics;
      return ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
    }();
    return *made;
  }

  static ShaderOptions options(bool lenient) {
    ShaderOptions options;
    options.compile.backend = Backend::interpreter;
    options.graph.lenient = lenient;
    return options;
  }

  /// Strictly an error; leniently a warning of the same code at the same place, from check
  /// and from compiling, and these numbers.
  static void expect(const std::string& nodes, const std::string& code, const std::string& path,
                     const std::vector<float>& expected) {
    SCOPED_TRACE(nodes);
    Diagnostics reading;
    const auto document = read_document_text(
        "<materialx version=\"1.39\">" + nodes + "</materialx>", "test.mtlx", {}, reading);
    ASSERT_NE(document, nullptr) << reading.to_string();

    Diagnostics strict;
    EXPECT_EQ(system().compile_outputs(*document, {"out"}, options(false), strict), nullptr);
    EXPECT_TRUE(says(strict, Severity::error, code, path)) << strict.to_string();
    Diagnostics checked;
    system().check(*document, options(false), checked);
    EXPECT_TRUE(says(checked, Severity::error, code, path)) << checked.to_string();

    Diagnostics lenient;
    const auto kernel = system().compile_outputs(*document, {"out"}, options(true), lenient);
    ASSERT_NE(kernel, nullptr) << lenient.to_string();
    EXPECT_TRUE(says(lenient, Severity::warning, code, path)) << lenient.to_string();
    Diagnostics leniently_checked;
    system().check(*document, options(true), leniently_checked);
    EXPECT_FALSE(leniently_checked.has_errors()) << leniently_checked.to_string();
    EXPECT_TRUE(says(leniently_checked, Severity::warning, code, path))
        << leniently_checked.to_string();

    const Program& program = kernel->kernel.program();
    ASSERT_EQ(program.outputs.size(), expected.size());
    const std::vector<float> zeros(program.inputs.size(), 0.0f);
    std::vector<const void*> in;
    for (const float& zero : zeros) in.push_back(&zero);
    std::vector<float> results(expected.size());
    std::vector<void*> out;
    for (float& result : results) out.push_back(&result);
    EXPECT_EQ(kernel->kernel.run(in, out, 1), RunStatus::done);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_FLOAT_EQ(results[i], expected[i]) << i;
  }

  static bool says(const Diagnostics& diagnostics, Severity severity, const std::string& code,
                   const std::string& path) {
    for (const Diagnostic& one : diagnostics.all()) {
      if (one.severity == severity && one.code == code && one.where.path == path &&
          one.where.line > 0 && one.where.file == "test.mtlx") {
        return true;
      }
    }
    return false;
  }

  static void expect_constant(const std::string& type, const std::string& value,
                              const std::vector<float>& expected) {
    expect(
        constant(type, value) + fmt::format(R"(<output name="out" type="{}" nodename="k"/>)", type),
        "bad-value", "k/value", expected);
  }

  static void expect_connection(const std::string& from, const std::string& value,
                                const std::string& to, const std::vector<float>& expected) {
    const std::string dot = fmt::format(
        R"(<dot name="d" type="{0}"><input name="in" type="{0}" nodename="k"/></dot>
           <output name="out" type="{0}" nodename="d"/>)",
        to);
    expect(constant(from, value) + dot, "type-mismatch", "d/in", expected);
  }
};

TEST_F(Lenient, SeveralNumbersForOneAreTheFirst) {
  expect_constant("float", "10,5,1", {10});
  expect_constant("float", "0,5", {0});
  expect_constant("float", "1 2", {1});
  expect_constant("float", "1,", {1});
}

TEST_F(Lenient, WhatProgramsWriteBehindNumbers) {
  expect_constant("float", "1.5f", {1.5f});
  expect_constant("color3", "0.1f, 0.2f, 0.3f", {0.1f, 0.2f, 0.3f});
  expect_constant("color3", "0.1; 0.2; 0.3", {0.1f, 0.2f, 0.3f});
  expect_constant("color3", "0.1, , 0.2, 0.3", {0.1f, 0.2f, 0.3f});
  expect_constant("color3", ",0.1,0.2,0.3", {0.1f, 0.2f, 0.3f});
}

TEST_F(Lenient, NumbersForEveryComponent) {
  expect_connection("float", "0.25", "color3", {0.25f, 0.25f, 0.25f});
  expect_connection("float", "0.25", "color4", {0.25f, 0.25f, 0.25f, 0.25f});
  expect_connection("float", "0.25", "vector2", {0.25f, 0.25f});
  expect_connection("integer", "3", "vector3", {3, 3, 3});
  expect_connection("integer", "3", "float", {3});
}

TEST_F(Lenient, ColoursAndVectorsStandForEachOther) {
  expect_connection("color3", "0.1, 0.2, 0.3", "vector3", {0.1f, 0.2f, 0.3f});
  expect_connection("vector3", "0.1, 0.2, 0.3", "color3", {0.1f, 0.2f, 0.3f});
  expect_connection("color4", "0.1, 0.2, 0.3, 0.4", "vector4", {0.1f, 0.2f, 0.3f, 0.4f});
  expect_connection("vector4", "0.1, 0.2, 0.3, 0.4", "color4", {0.1f, 0.2f, 0.3f, 0.4f});
}

TEST_F(Lenient, InputsOfAnotherType) {
  expect(R"(<multiply name="c" type="color3" nodedef="ND_multiply_color3">
      <input name="in1" type="color3" value="0.1, 0.2, 0.3"/><input name="in2" type="float" value="0.5"/>
      </multiply><output name="out" type="color3" nodename="c"/>)",
         "input-type", "c/in2", {0.05f, 0.1f, 0.15f});
  expect(
      R"(<multiply name="c" type="color3"><input name="in1" type="vector3" value="0.1, 0.2, 0.3"/>
      <input name="in2" type="color3" value="0.5, 0.5, 0.5"/></multiply>
      <output name="out" type="color3" nodename="c"/>)",
      "input-type", "c/in1", {0.05f, 0.1f, 0.15f});
}

TEST_F(Lenient, UnknownInputsAreLeftOut) {
  for (const char* nodedef : {"", "nodedef=\"ND_mix_color3\""}) {
    expect(fmt::format(R"(<mix name="c" type="color3" {}><input name="fg" type="color3"
        value="0.1, 0.2, 0.3"/><input name="mix" type="float" value="0.5"/>
        <input name="amount" type="float" value="0.7"/></mix>
        <output name="out" type="color3" nodename="c"/>)",
                       nodedef),
           "unknown-input", "c/amount", {0.05f, 0.1f, 0.15f});
  }
}

TEST_F(Lenient, OfSeveralOutputsTheFirst) {
  expect(constant("color3", "0.1, 0.2, 0.3") +
             R"(<separate3 name="s" type="multioutput"><input name="in" type="color3" nodename="k"/>
                </separate3><output name="out" type="float" nodename="s"/>)",
         "output-required", "out", {0.1f});
  expect(R"(<nodegraph name="G"><constant name="x" type="color3"><input name="value" type="color3"
             value="0.1, 0.2, 0.3"/></constant><constant name="y" type="color3"/>
             <output name="o1" type="color3" nodename="x"/><output name="o2" type="color3" nodename="y"/>
             </nodegraph><dot name="d" type="color3"><input name="in" type="color3" nodegraph="G"/></dot>
             <output name="out" type="color3" nodename="d"/>)",
         "output-required", "d/in", {0.1f, 0.2f, 0.3f});
}

TEST_F(Lenient, AWrongNameForTheOnlyOutput) {
  expect(
      constant("float", "0.5") + R"(<output name="out" type="float" nodename="k" output="value"/>)",
      "unknown-output", "out", {0.5f});
}

TEST_F(Lenient, InterfacesThatAreNotThere) {
  const auto graph = [](const char* value) {
    return fmt::format(R"(<nodegraph name="G"><constant name="c" type="float"><input name="value"
        type="float" interfacename="gone" {}/></constant><output name="o" type="float" nodename="c"/>
        </nodegraph><dot name="d" type="float"><input name="in" type="float" nodegraph="G" output="o"/>
        </dot><output name="out" type="float" nodename="d"/>)",
                       value);
  };
  expect(graph(""), "unknown-interface", "G/c/value", {0});
  expect(graph("value=\"0.75\""), "unknown-interface", "G/c/value", {0.75f});
}

TEST_F(Lenient, OutputsThatNothingFeedsAreZero) {
  expect(R"(<output name="out" type="color3"/>)", "unconnected-output", "out", {0, 0, 0});
}

TEST_F(Lenient, ColoursOfUnknownSpacesStayAsTheyAre) {
  expect(R"(<constant name="c" type="color3"><input name="value" type="color3"
      value="0.1, 0.2, 0.3" colorspace="Utility - Rec.709 - Camera"/></constant>
      <output name="out" type="color3" nodename="c"/>)",
         "unknown-colorspace", "c/value", {0.1f, 0.2f, 0.3f});
}

/// What generated code has no meaning for, or one that nobody means.
TEST_F(Lenient, NonsenseStaysAnError) {
  for (const char* value : {"1/2", "50%", "0x10", "half", "", "1e", "nan", "1.0ff"}) {
    Diagnostics diagnostics;
    const auto document =
        read_document_text("<materialx version=\"1.39\">" + constant("float", value) +
                               R"(<output name="out" type="float" nodename="k"/></materialx>)",
                           "test.mtlx", {}, diagnostics);
    EXPECT_EQ(system().compile_outputs(*document, {"out"}, options(true), diagnostics), nullptr);
    EXPECT_TRUE(says(diagnostics, Severity::error, "bad-value", "k/value")) << value;
  }
  for (const char* types : {"color3 float", "color4 color3", "vector2 color3", "color3 color4",
                            "boolean float", "float integer"}) {
    const std::string text = types;
    const std::string from = text.substr(0, text.find(' '));
    const std::string to = text.substr(from.size() + 1);
    Diagnostics diagnostics;
    const auto document =
        read_document_text(fmt::format(R"(<materialx version="1.39"><constant name="k" type="{0}"/>
            <dot name="d" type="{1}"><input name="in" type="{1}" nodename="k"/></dot>
            <output name="out" type="{1}" nodename="d"/></materialx>)",
                                       from, to),
                           "test.mtlx", {}, diagnostics);
    EXPECT_EQ(system().compile_outputs(*document, {"out"}, options(true), diagnostics), nullptr);
    EXPECT_TRUE(says(diagnostics, Severity::error, "type-mismatch", "d/in")) << types;
  }
}

}  // namespace
}  // namespace nacre
