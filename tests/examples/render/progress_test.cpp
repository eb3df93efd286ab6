// Renders that end early, go on from a checkpoint, or stop where the image is good enough.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stop_token>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/render.h"
#include "examples/render/tiles.h"
#include "tests/examples/render/test_shaders.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

TEST(TileQueue, HandsOutTheTileWithTheFewestSamplesTwiceAsManyEachTime) {
  TileQueue queue({0, 0}, 200, 4);
  std::vector<int> ends;
  while (const auto work = queue.take()) {
    const auto other = queue.take();  // Never the same, which is busy.
    if (other) {
      EXPECT_NE(other->tile, work->tile);
      EXPECT_EQ(other->last, work->last);
      queue.give_back(*other, other->last, false, {});
    }
    ends.push_back(work->last);
    queue.give_back(*work, work->last, false, {});
  }
  EXPECT_EQ(ends, (std::vector{4, 8, 16, 32, 64, 128, 192, 200}));
}

TEST(TileQueue, EndsAreTheSameWhereverARenderWasInterrupted) {
  for (int done = 0; done < 200; ++done) {
    TileQueue queue({done}, 200, 4);
    const auto work = queue.take();
    ASSERT_TRUE(work);
    EXPECT_EQ(work->first, done);
    EXPECT_TRUE(queue.is_end(work->last)) << done;
    for (int k = done + 1; k < work->last; ++k) EXPECT_FALSE(queue.is_end(k)) << k;
  }
}

TEST(TileQueue, WrapsUpWithTilesThatHaveNothing) {
  TileQueue queue({0, 4, 0}, 64, 4);
  queue.wrap_up();
  const auto one = queue.take(), two = queue.take();
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->tile + two->tile, 2u);
  EXPECT_FALSE(queue.take());
}

TEST(RenderCounts, AllAddUp) {
  // Nine numbers, each of its own.
  RenderCounts sum{1, 2, 3, 4, 5, 6, 7, 8.0, 9.0};
  sum.add({10, 20, 30, 40, 50, 60, 70, 80.0, 90.0});
  EXPECT_EQ(sum.paths, 11u);
  EXPECT_EQ(sum.rays, 22u);
  EXPECT_EQ(sum.shadow_rays, 33u);
  EXPECT_EQ(sum.invalid_results, 44u);
  EXPECT_EQ(sum.beyond_bound, 55u);
  EXPECT_EQ(sum.media_dropped, 66u);
  EXPECT_EQ(sum.paths_cut, 77u);
  EXPECT_EQ(sum.shading_seconds, 88.0);
  EXPECT_EQ(sum.tracing_seconds, 99.0);
}

class Progress : public ::testing::Test {
 protected:
  Progress() {
    scene_.meshes.push_back(make_quad("floor", {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    scene_.meshes.push_back(
        make_quad_light("lamp", {-0.5f, 1.f, -0.75f}, {1.f, 0, 0}, {0, 0, 1.5f}, {3.f, 2.f, 1.f}));
    settings_.width = 48;
    settings_.height = 40;
    settings_.tile_size = 16;
    settings_.samples = 128;
    settings_.threads = 2;
    settings_.passes.passes.push_back(*find_pass("direct"));
    settings_.passes.object_mattes = true;
  }

  std::optional<Film> film(const RenderControl& control = {},
                           RenderStatistics* statistics = nullptr) {
    return render(
        {&scene_, {&grey_, nullptr}, nullptr, look_at({4.f, 0.7f, 0.f}, {0.f, 0.f, 0.f}, 0.8f)},
        settings_, diagnostics_, control, statistics);
  }

  Scene scene_;
  const LambertShader grey_{{0.6f, 0.3f, 1.f}};
  RenderSettings settings_;
  Diagnostics diagnostics_;
  TemporaryFolder folder_;
};

void expect_same(const Film& a, const Film& b) {
  ASSERT_EQ(a.pixels().size(), b.pixels().size());
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    ASSERT_EQ(a.pixels()[i].x, b.pixels()[i].x) << i;
    ASSERT_EQ(a.pixels()[i].z, b.pixels()[i].z) << i;
  }
  EXPECT_EQ(a.passes.planes, b.passes.planes);
  EXPECT_EQ(a.passes.mattes.at(0).planes, b.passes.mattes.at(0).planes);
}

TEST_F(Progress, HasTheSamplesThatThereAre) {
  std::stop_source enough;
  enough.request_stop();
  RenderStatistics statistics;
  const auto early = film({.enough = enough.get_token()}, &statistics);
  ASSERT_TRUE(early);  // Every pixel has something.
  EXPECT_GT(statistics.least_samples, 0);
  EXPECT_LT(statistics.most_samples, 128);
  // That is what a render of so few samples is.
  settings_.samples = statistics.least_samples;
  ASSERT_EQ(statistics.least_samples, statistics.most_samples);
  expect_same(*early, *film());
}

TEST_F(Progress, GoesOnFromACheckpointWithTheSameBits) {
  RenderStatistics all;
  const auto whole = film({}, &all);
  ASSERT_TRUE(whole);
  std::optional<Film> last;
  int interruptions = 0;
  for (int steps = 1; !last && interruptions < 100; steps += 3) {
    // Stops after so many pieces of work, somewhere within others.
    std::stop_source enough;
    int pieces = 0;
    Checkpoint checkpoint(folder_.file("a.checkpoint"), "key", 1e9);
    RenderStatistics statistics;
    auto found = film({.enough = enough.get_token(),
                       .progress =
                           [&](double) {
                             if (++pieces == steps) enough.request_stop();
                           },
                       .checkpoint = &checkpoint},
                      &statistics);
    ASSERT_TRUE(found) << diagnostics_.to_string();
    EXPECT_LE(statistics.rays, all.rays);
    if (statistics.least_samples == settings_.samples) {
      last = std::move(found);
      // What was counted is of all runs.
      EXPECT_EQ(statistics.paths, all.paths);
      EXPECT_EQ(statistics.rays, all.rays);
      EXPECT_EQ(statistics.shadow_rays, all.shadow_rays);
    }
    ++interruptions;
  }
  ASSERT_TRUE(last);
  EXPECT_GT(interruptions, 3);
  expect_same(*last, *whole);
}

TEST_F(Progress, RefusesCheckpointsOfSomethingElse) {
  const std::string file = folder_.file("a.checkpoint");
  Checkpoint mine(file, "key", 1e9), other(file, "another", 1e9);
  ASSERT_TRUE(film({.checkpoint = &mine}));
  EXPECT_FALSE(film({.checkpoint = &other}));
  EXPECT_NE(diagnostics_.to_string().find("bad-checkpoint"), std::string::npos);
  settings_.width = 64;
  EXPECT_FALSE(film({.checkpoint = &mine}));
  settings_.width = 48;
  std::string bytes;
  {
    std::ifstream in(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  for (const std::size_t cut : {std::size_t{0}, std::size_t{10}, bytes.size() / 2}) {
    std::ofstream(file, std::ios::binary) << bytes.substr(0, cut);
    EXPECT_FALSE(film({.checkpoint = &mine})) << cut;
  }
  std::string old = bytes;
  old[std::string_view("nacre render checkpoint ").size()] = '1';
  std::ofstream(file, std::ios::binary) << old;
  EXPECT_FALSE(film({.checkpoint = &mine}));
  EXPECT_NE(diagnostics_.to_string().find("another version"), std::string::npos);
  bytes[bytes.size() - 5] ^= 1;
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_FALSE(film({.checkpoint = &mine}));
}

// The floor far from the lamp has little noise and soon enough samples. What a tile gets does not
// depend on threads, and its true error is what was asked for or below.
TEST_F(Progress, TilesStopWhereTheyAreGoodEnough) {
  settings_.sampler = SamplerKind::independent;  // As the estimate takes samples to be.
  settings_.samples = 4096;
  settings_.noise = 0.02;
  RenderStatistics statistics;
  const auto adaptive = film({}, &statistics);
  ASSERT_TRUE(adaptive);
  EXPECT_EQ(statistics.noisy_tiles, 0u);
  EXPECT_LT(statistics.least_samples, statistics.most_samples);
  settings_.threads = 5;
  expect_same(*adaptive, *film());
  settings_.noise = 0;
  settings_.seed = 7;
  const auto exact = film();
  for (const Tile& tile :
       make_tiles(settings_.width, settings_.height, settings_.tile_size, window_of(settings_))) {
    double sum = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const auto want = static_cast<double>(exact->mean(x, y).x);
        const double off = static_cast<double>(adaptive->mean(x, y).x) - want;
        sum += off * off / (want * want + 0.01);
      }
    }
    // The other render has an error, too, and both are of random numbers.
    EXPECT_LT(std::sqrt(sum / static_cast<double>(tile.pixels())), 1.5 * 0.02)
        << tile.x0 << ' ' << tile.y0;
  }
}

}  // namespace
}  // namespace nacre::host
