// Tiles of a set that are loaded when points may read them.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

/// Grey, one texel, 8 bits; a file of Truevision's TGA.
std::string grey(unsigned char value) {
  std::string file(18, '\0');
  file[2] = 3;
  file[12] = file[14] = 1;
  file[16] = 8;
  return file + static_cast<char>(value);
}

constexpr const char* text = R"(<materialx version="1.39">
  <image name="i" type="float">
    <input name="file" type="filename" value="t.&lt;UDIM&gt;.tga"/></image>
  <output name="out" type="float" nodename="i"/></materialx>)";

class DeferredTiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("t.1001.tga", grey(51));
    folder_.write("t.1002.tga", grey(102));
    Diagnostics diagnostics;
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
    ASSERT_NE(system_, nullptr) << diagnostics.to_string();
    document_ = read_document_text(text, folder_.file("d.mtlx"), {}, diagnostics);
    ASSERT_NE(document_, nullptr) << diagnostics.to_string();
    options_.defer_tiles = true;
    options_.footprints = false;
    options_.compile.backend = Backend::interpreter;
  }

  std::unique_ptr<OutputKernel> compiled() {
    auto kernel = system_->compile_outputs(*document_, {"out"}, options_, diagnostics_);
    EXPECT_NE(kernel, nullptr) << diagnostics_.to_string();
    return kernel;
  }

  /// At (u, 0.5), with the tiles that points of a range of u may read.
  float value_at(const BoundKernel& kernel, float u, double low, double high) {
    std::vector<Range> ranges;
    std::vector<const void*> inputs;
    const float v = 0.5f;
    for (const Channel& channel : kernel.program().inputs) {
      const bool is_u = channel.name.ends_with(".x");
      ranges.push_back(is_u ? Range{low, high, false} : Range{0.5, 0.5, false});
      inputs.push_back(is_u ? &u : &v);
    }
    float value = -1;
    void* outputs[]{&value};
    const BoundKernel loaded = kernel.within(ranges, diagnostics_);
    EXPECT_EQ(loaded.run(inputs, outputs, 1), RunStatus::done);
    return value;
  }

  TemporaryFolder folder_;
  std::unique_ptr<ShadingSystem> system_;
  std::unique_ptr<Document> document_;
  ShaderOptions options_;
  Diagnostics diagnostics_;
};

TEST_F(DeferredTiles, AreThoseThatPointsMayRead) {
  const auto kernel = compiled();
  ASSERT_NE(kernel, nullptr);
  EXPECT_TRUE(kernel->kernel.has_deferred_tiles());
  EXPECT_FLOAT_EQ(value_at(kernel->kernel, 0.5f, 0.25, 0.75), 0.2f);
  EXPECT_FLOAT_EQ(value_at(kernel->kernel, 1.5f, 1.25, 1.75), 0.4f);
  EXPECT_EQ(value_at(kernel->kernel, 1.5f, 0.25, 0.75), 0.0f);  // Not loaded.
  EXPECT_EQ(diagnostics_.to_string(), "");
}

// Baking hundreds of them takes longer than compiling may.
TEST_F(DeferredTiles, HaveMoreTimeThanCompiling) {
  options_.compile.stop = Stop().within(1);
  const auto kernel = compiled();
  ASSERT_NE(kernel, nullptr);
  while (!options_.compile.stop.is_late())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FLOAT_EQ(value_at(kernel->kernel, 1.5f, 1.25, 1.75), 0.4f);
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(DeferredTiles, AreNotLoadedWhereSomebodyAsksToStop) {
  std::stop_source source;
  options_.compile.stop = Stop(source.get_token());
  const auto kernel = compiled();
  ASSERT_NE(kernel, nullptr);
  source.request_stop();
  EXPECT_EQ(value_at(kernel->kernel, 1.5f, 1.25, 1.75), 0.0f);
  ASSERT_EQ(diagnostics_.all().size(), 1u);
  EXPECT_EQ(diagnostics_.all()[0].code, "stopped");
}

}  // namespace
}  // namespace nacre
