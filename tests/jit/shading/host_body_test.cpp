// What a host's body does wrong is a diagnostic at the node that called for it.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

/// The line of the node in the document below.
constexpr int line_of_node = 2;

/// A checkerboard's body, which has inputs and the output of a color3, is the host's.
std::unique_ptr<ShadingSystem> system_with(std::function<void(NodeCall&)> body,
                                           Diagnostics& diagnostics) {
  return ShadingSystem::create(
      {.libraries = {standard_library_folder()},
       .bodies = {{.nodedef = "ND_checkerboard_color3", .record = std::move(body)}}},
      diagnostics);
}

std::unique_ptr<OutputKernel> compile(ShadingSystem& system, Diagnostics& diagnostics) {
  const auto document = read_document_text(R"(<materialx version="1.39">
    <checkerboard name="c" type="color3"/>
    <output name="out" type="color3" nodename="c"/></materialx>)",
                                           "host.mtlx", {}, diagnostics);
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  return system.compile_outputs(*document, {"out"}, options, diagnostics);
}

/// No kernel, and the one error is of the host's node.
void expect_misfit(std::function<void(NodeCall&)> body) {
  Diagnostics diagnostics;
  const auto system = system_with(std::move(body), diagnostics);
  ASSERT_NE(system, nullptr) << diagnostics.to_string();
  EXPECT_EQ(compile(*system, diagnostics), nullptr);
  ASSERT_TRUE(diagnostics.has_errors());
  const Diagnostic& first = diagnostics.all().front();
  EXPECT_EQ(first.code, "port-mismatch") << diagnostics.to_string();
  EXPECT_EQ(first.where.line, line_of_node);
  EXPECT_NE(first.message.find("ND_checkerboard_color3"), std::string::npos) << first.message;
}

TEST(HostBody, SetsNothing) {
  expect_misfit([](NodeCall&) {});
}

TEST(HostBody, SetsTooFewNumbers) {
  expect_misfit([](NodeCall& call) { call.set(call.vector2("uvtiling")); });
}

TEST(HostBody, SetsAnotherType) {
  expect_misfit([](NodeCall& call) {
    const Bool yes(true);
    call.set({yes.ref(), yes.ref(), yes.ref()});
  });
}

TEST(HostBody, SetsAnOutputThatIsNotThere) {
  expect_misfit([](NodeCall& call) { call.set("colour", call.vector3("color1")); });
}

TEST(HostBody, ReadsAnInputThatIsNotThere) {
  expect_misfit([](NodeCall& call) { call.set(call.vector3("colour1")); });
}

/// A body that keeps a value for the next kernel, whose Program does not have it.
TEST(HostBody, SetsAValueOfAnotherRecording) {
  Recorder elsewhere;
  const Float kept(elsewhere.input("uv0.x", Scalar::f32));
  expect_misfit([kept](NodeCall& call) { call.set(Float3{kept, kept, kept}); });
}

TEST(HostBody, SaysWhatItCannotDo) {
  Diagnostics diagnostics;
  const auto system = system_with(
      [](NodeCall& call) {
        call.diagnostics().error("no-such-pattern", call.where(), "there is no such pattern");
        call.set(call.vector3("color1"));
      },
      diagnostics);
  ASSERT_NE(system, nullptr) << diagnostics.to_string();
  EXPECT_EQ(compile(*system, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.error_count(), 1u) << diagnostics.to_string();
}

TEST(HostBody, IsAFunction) {
  Diagnostics diagnostics;
  EXPECT_EQ(system_with({}, diagnostics), nullptr);
  ASSERT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.all().front().code, "empty-body");
}

/// The document and the way to a kernel are right where the body is.
TEST(HostBody, MayBeRight) {
  Diagnostics diagnostics;
  const auto system =
      system_with([](NodeCall& call) { call.set(call.vector3("color1")); }, diagnostics);
  ASSERT_NE(system, nullptr) << diagnostics.to_string();
  EXPECT_NE(compile(*system, diagnostics), nullptr) << diagnostics.to_string();
}

}  // namespace
}  // namespace nacre
