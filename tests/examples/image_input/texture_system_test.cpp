#include <OpenImageIO/texture.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <thread>

#include "examples/image_input/graph_input.h"
#include "examples/image_input/open_graph.h"
#include "examples/image_input/output_store.h"
#include "examples/image_input/read_request.h"
#include "tests/examples/image_input/image_fixture.h"

namespace graph_image {
namespace {

class GraphImageTextures : public GraphImages {
 protected:
  /// Two channels at (s, t) of a texture, t from the top, for a footprint as wide as high.
  std::pair<float, float> look_up(const std::string& name, float s, float t, float width) {
    OIIO::TextureOpt options;
    float result[2] = {-1.0f, -1.0f};
    EXPECT_TRUE(
        system_->texture(OIIO::ustring(name), options, s, t, width, 0.0f, 0.0f, width, 2, result))
        << system_->geterror();
    return {result[0], result[1]};
  }
  int statistic(const char* name) const {
    int value = -1;
    EXPECT_TRUE(cache_->getattribute(name, value));
    return value;
  }

  // What all of a program have in common, and goes after everything else: destroying one of one's
  // own is a fault of OpenImageIO's (2.4), which frees it as an object of another type.
  OIIO::ImageCache* cache_ = OIIO::ImageCache::create(true);
  OIIO::TextureSystem* system_ = OIIO::TextureSystem::create(true);
};

TEST_F(GraphImageTextures, ARampIsItselfAtAnyWidth) {
  const std::string name = write("ramp.mtlx", ramp()) + "?size=1024";
  for (const float width : {0.0f, 0.001f, 0.01f, 0.1f}) {
    for (int i = 0; i < 25; ++i) {
      const float s = 0.25f + 0.125f * static_cast<float>(i % 5);
      const float t = 0.25f + 0.125f * static_cast<float>(i / 5);
      const auto [u, v] = look_up(name, s, t, width);
      EXPECT_NEAR(u, s, 1e-5f) << width;
      EXPECT_NEAR(v, 1.0f - t, 1e-5f) << width;
    }
  }
}

TEST_F(GraphImageTextures, APlacedGradientIsTheLinearFunctionThatItIs) {
  // place2d: divided by the scale, turned, then moved.
  const std::string name = write("placed.mtlx", document_of(R"(<texcoord name="uv" type="vector2" />
<place2d name="placed" type="vector2">
  <input name="texcoord" type="vector2" nodename="uv" />
  <input name="scale" type="vector2" value="0.5, 2" />
  <input name="rotate" type="float" value="30" />
  <input name="offset" type="vector2" value="0.25, -0.5" />
</place2d>
<output name="out" type="vector2" nodename="placed" />)")) +
                           "?size=512";
  const double angle = std::numbers::pi / 6;
  for (int i = 0; i < 25; ++i) {
    const double s = 0.25 + 0.125 * (i % 5), t = 0.25 + 0.125 * (i / 5);
    const double x = s / 0.5, y = (1 - t) / 2;
    const auto [a, b] = look_up(name, static_cast<float>(s), static_cast<float>(t), 0.004f);
    EXPECT_NEAR(a, std::cos(angle) * x + std::sin(angle) * y - 0.25, 2e-5);
    EXPECT_NEAR(b, -std::sin(angle) * x + std::cos(angle) * y + 0.5, 2e-5);
  }
}

TEST_F(GraphImageTextures, AWaveIsThereWithinWhatFiltersLose) {
  // sin(8 pi u): bilinear interpolation of n texels loses up to (8 pi / n)^2 / 8.
  const std::string name = write("wave.mtlx", document_of(R"(<texcoord name="uv" type="vector2" />
<multiply name="phase" type="vector2">
  <input name="in1" type="vector2" nodename="uv" /><input name="in2" type="float" value="25.132741" />
</multiply>
<sin name="wave" type="vector2"><input name="in" type="vector2" nodename="phase" /></sin>
<output name="out" type="vector2" nodename="wave" />)")) +
                           "?size=1024";
  OIIO::TextureOpt options;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;
  options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
  const double loss = std::pow(8 * std::numbers::pi / 1024, 2) / 8;
  for (int i = 0; i < 100; ++i) {
    const float s = static_cast<float>(i) / 100;
    float result[2];
    ASSERT_TRUE(system_->texture(OIIO::ustring(name), options, s, 0.3f, 0, 0, 0, 0, 2, result));
    EXPECT_NEAR(result[0], std::sin(8 * std::numbers::pi * static_cast<double>(s)), loss + 1e-5);
  }
}

TEST_F(GraphImageTextures, OnlyTilesThatAreLookedAtAreShaded) {
  const std::string name = write("huge.mtlx", ramp()) + "?size=65536";
  ASSERT_TRUE(cache_->add_file(OIIO::ustring(name), [] {
    return static_cast<OIIO::ImageInput*>(new GraphInput(open_graph));
  }));
  const int tiles_before = statistic("stat:tiles_created");
  for (const float s : {0.1f, 0.5f, 0.9f}) {
    const auto [u, v] = look_up(name, s, 0.25f, 0.0f);
    EXPECT_NEAR(u, s, 1e-5f);
    EXPECT_NEAR(v, 0.75f, 1e-5f);
  }
  const int tiles = statistic("stat:tiles_created") - tiles_before;
  EXPECT_GE(tiles, 3);
  EXPECT_LE(tiles, 24);  // Four of two levels, each time.
  const auto ready = shared_store().get(read_request(name, nullptr));
  // Of the next coarser level four points a texel.
  EXPECT_LE(ready->output->points(), std::uint64_t{4096} * 4 * static_cast<unsigned>(tiles));
  const std::uint64_t before = ready->output->points();
  look_up(name, 0.1f, 0.25f, 0.0f);
  EXPECT_EQ(ready->output->points(), before);  // Those tiles are there.
}

TEST_F(GraphImageTextures, AClosedFileIsOpenedWithoutCompilingAgain) {
  OutputStore store(2);
  const std::string file = write("ramp.mtlx", ramp());
  const auto first = store.get(read_request(file + "?size=64", nullptr));
  EXPECT_EQ(store.get(read_request(file + "?size=128&time=3", nullptr)), first);
  EXPECT_NE(store.get(read_request(file + "?accuracy=precise", nullptr)), first);
  // Two are kept: of three the one that was asked for last first is made again.
  store.get(read_request(file + "?accuracy=fast", nullptr));
  EXPECT_NE(store.get(read_request(file, nullptr)), first);
}

TEST_F(GraphImageTextures, WhatChangedIsSeenWhenItIsOpenedAgain) {
  const std::string included =
      "<materialx version=\"1.39\"><nodegraph name=\"G\">"
      "<constant name=\"c\" type=\"float\"><input name=\"value\" "
      "type=\"float\" value=\"VALUE\" /></constant><output name=\"out\" "
      "type=\"float\" nodename=\"c\" /></nodegraph></materialx>";
  const auto with = [&](const char* value) {
    std::string text = included;
    return text.replace(text.find("VALUE"), 5, value);
  };
  write("part.mtlx", with("0.25"));
  const std::string file =
      write("whole.mtlx",
            "<materialx version=\"1.39\" xmlns:xi=\"http://www.w3.org/2001/XInclude\">"
            "<xi:include href=\"part.mtlx\" /></materialx>");
  const std::string name = file + "?size=16";
  const auto grey_of = [&] { return look_up(name, 0.5f, 0.5f, 0.0f).first; };
  EXPECT_EQ(grey_of(), 0.25f);
  write("part.mtlx", with("0.75"));  // As long as before: the time says that it is another.
  EXPECT_EQ(grey_of(), 0.25f);
  cache_->invalidate(OIIO::ustring(name), true);
  EXPECT_EQ(grey_of(), 0.75f);
  write("whole.mtlx", grey("0.5"));
  cache_->invalidate_all(false);  // A name with a query is no file, so it always counts as changed.
  EXPECT_EQ(grey_of(), 0.5f);
  write("whole.mtlx", "no document");
  cache_->invalidate(OIIO::ustring(name), true);
  OIIO::TextureOpt options;
  float result[1];
  EXPECT_FALSE(system_->texture(OIIO::ustring(name), options, 0, 0, 0, 0, 0, 0, 1, result));
  EXPECT_NE(system_->geterror().find(file), std::string::npos);
  write("whole.mtlx", grey("0.125"));
  cache_->invalidate(OIIO::ustring(name), true);
  EXPECT_EQ(grey_of(), 0.125f);
}

TEST_F(GraphImageTextures, TextFilesAreFoundInTheSearchPath) {
  write("ramp.mtlx", ramp());
  write("ramp.mtlxtex", "ramp.mtlx?size=128\n");
  cache_->attribute("searchpath", folder_.path().string());
  const auto [u, v] = look_up("ramp.mtlxtex", 0.5f, 0.25f, 0.0f);
  EXPECT_NEAR(u, 0.5f, 1e-5f);
  EXPECT_NEAR(v, 0.75f, 1e-5f);
}

TEST_F(GraphImageTextures, TextFilesMakeASetOfTiles) {
  write("ramp.mtlx", ramp());
  for (const char* tile : {"1001", "1002", "1012"}) {
    write(std::string("ramp.") + tile + ".mtlxtex",
          std::string("ramp.mtlx?size=128&udim=") + tile + "\n");
  }
  const std::string name = folder_.file("ramp.<UDIM>.mtlxtex");
  // The whole part of t counts tiles upwards; in each of them t goes down from the top.
  for (const auto& [s, t] : {std::pair{0.25f, 0.75f}, {1.5f, 0.25f}, {1.25f, 1.5f}}) {
    const auto [u, v] = look_up(name, s, t, 0.0f);
    EXPECT_NEAR(u, s, 1e-5f);
    EXPECT_NEAR(v, std::floor(t) + 1.0f - (t - std::floor(t)), 1e-5f);
  }
}

TEST_F(GraphImages, ManyThreadsReadWhatOneReads) {
  const std::string name = marble_ + "?output=NG_marble/base_color&size=512";
  const auto alone = open(name);
  ASSERT_NE(alone, nullptr);
  const std::vector<float> expected = read(*alone);
  const auto shared = open(name);
  ASSERT_NE(shared, nullptr);
  constexpr int threads = 8, tiles = 64;
  std::vector<std::vector<float>> found(tiles, std::vector<float>(64 * 64 * 3));
  std::vector<std::thread> running;
  for (int thread = 0; thread < threads; ++thread) {
    running.emplace_back([&, thread] {
      // Half of them have the reader in common, half open their own.
      const auto mine = thread % 2 == 0 ? OIIO::ImageInput::open(name) : nullptr;
      OIIO::ImageInput& reader = mine != nullptr ? *mine : *shared;
      for (int tile = thread; tile < tiles; tile += threads) {
        reader.read_native_tile(0, 0, tile % 8 * 64, tile / 8 * 64, 0,
                                found[static_cast<std::size_t>(tile)].data());
      }
    });
  }
  for (std::thread& thread : running) thread.join();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::size_t x = i / 3 % 512, y = i / 3 / 512;
    ASSERT_EQ(found[y / 64 * 8 + x / 64][((y % 64) * 64 + x % 64) * 3 + i % 3], expected[i]) << i;
  }
}

TEST_F(GraphImageTextures, ManyThreadsLookUpWhileFilesAreClosed) {
  cache_->attribute("max_open_files", 2);
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i) {
    names.push_back(write("ramp" + std::to_string(i) + ".mtlx", ramp()) + "?size=256");
  }
  std::atomic<int> faults = 0;
  std::vector<std::thread> running;
  for (int thread = 0; thread < 8; ++thread) {
    running.emplace_back([&, thread] {
      for (int i = 0; i < 200; ++i) {
        const int k = i * 8 + thread;
        const float s = 0.1f + 0.8f * static_cast<float>(k % 97) / 97;
        const float t = 0.1f + 0.8f * static_cast<float>(k % 89) / 89;
        OIIO::TextureOpt options;
        float result[2] = {-1.0f, -1.0f};
        const bool done = system_->texture(OIIO::ustring(names[static_cast<std::size_t>(k % 6)]),
                                           options, s, t, 0.01f, 0, 0, 0.01f, 2, result);
        if (!done || std::abs(result[0] - s) > 1e-5f || std::abs(result[1] - 1 + t) > 1e-5f)
          ++faults;
      }
    });
  }
  for (std::thread& thread : running) thread.join();
  EXPECT_EQ(faults, 0);
}

}  // namespace
}  // namespace graph_image
