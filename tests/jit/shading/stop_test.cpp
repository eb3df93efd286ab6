// Every stage between a document and its kernels ends when it should, and says so.
#include <gtest/gtest.h>

#include <string>

#include "jit/document/read.h"
#include "jit/graph/build/build.h"
#include "jit/record/record.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

constexpr const char* file = "chain.mtlx";

/// Long enough that a stage which looks now and then looks before it is done.
std::string chain() {
  std::string text = "<materialx version=\"1.39\">\n<constant name=\"n0\" type=\"float\"/>\n";
  for (int i = 1; i < 20'000; ++i) {
    const std::string name = "n" + std::to_string(i), last = "n" + std::to_string(i - 1);
    text += "<sin name=\"" + name +
            "\" type=\"float\"><input name=\"in\" type=\"float\" nodename=\"" + last +
            "\"/></sin>\n";
  }
  return text + "<output name=\"out\" type=\"float\" nodename=\"n19999\"/>\n</materialx>\n";
}

ShadingSystem& system() {
  static Diagnostics diagnostics;
  static const auto made =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  return *made;
}

/// Asked for, and out of time.
struct Due {
  Stop stop;
  std::string code;
};

std::vector<Due> all_due() {
  std::stop_source source;
  source.request_stop();
  return {{Stop(source.get_token()), "stopped"}, {Stop().within(0), "compile-timeout"}};
}

void expect_one(const Diagnostics& diagnostics, const std::string& code) {
  ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.to_string();
  const Diagnostic& one = diagnostics.all().front();
  EXPECT_EQ(one.severity, Severity::error);
  EXPECT_EQ(one.code, code);
  EXPECT_EQ(one.where.file, file);
}

TEST(StopDue, EndsReading) {
  const std::string text = chain();
  for (const Due& due : all_due()) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.stop = due.stop;
    EXPECT_EQ(read_document_text(text, file, options, diagnostics), nullptr);
    expect_one(diagnostics, due.code);
  }
}

class StopDueLater : public testing::Test {
 protected:
  void SetUp() override {
    document_ = read_document_text(chain(), file, {}, diagnostics_);
    ASSERT_NE(document_, nullptr) << diagnostics_.to_string();
  }

  Diagnostics diagnostics_;
  std::unique_ptr<Document> document_;
};

TEST_F(StopDueLater, EndsBuilding) {
  for (const Due& due : all_due()) {
    Diagnostics diagnostics;
    GraphOptions options;
    options.stop = due.stop;
    EXPECT_FALSE(build_graph(*document_, system().library(), {.outputs = {"out"}, .material = {}},
                             options, diagnostics));
    expect_one(diagnostics, due.code);
  }
}

TEST_F(StopDueLater, EndsChecking) {
  for (const Due& due : all_due()) {
    Diagnostics diagnostics;
    ShaderOptions options;
    options.compile.stop = due.stop;
    system().check(*document_, options, diagnostics);
    expect_one(diagnostics, due.code);
  }
}

TEST_F(StopDueLater, EndsRecording) {
  const auto graph =
      build_graph(*document_, system().library(), {.outputs = {"out"}, .material = {}},
                  system().graph_options({}), diagnostics_);
  ASSERT_TRUE(graph) << diagnostics_.to_string();
  const Bodies bodies(system().library().definitions());
  for (const Due& due : all_due()) {
    Diagnostics diagnostics;
    RecordOptions options;
    options.stop = due.stop;
    Recorder recorder;
    EXPECT_FALSE(record_graph(*graph, bodies, options, recorder, diagnostics));
    expect_one(diagnostics, due.code);
  }
}

}  // namespace
}  // namespace nacre
