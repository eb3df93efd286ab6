// A crop has the pixels of the whole picture, whatever is asked for beside it.
#include <gtest/gtest.h>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

class Crop : public ::testing::Test {
 protected:
  Crop() {
    scene_.meshes.push_back(make_quad("floor", {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    scene_.meshes.push_back(
        make_quad_light("lamp", {-0.5f, 1.f, -0.75f}, {1.f, 0, 0}, {0, 0, 1.5f}, {3.f, 2.f, 1.f}));
    settings_.width = 50;
    settings_.height = 40;
    settings_.tile_size = 16;
    settings_.samples = 32;
    settings_.threads = 2;
    settings_.passes.passes = {*find_pass("direct"), *find_pass("position")};
    settings_.passes.object_mattes = true;
  }

  Film film(const std::optional<PixelWindow>& crop, const RenderControl& control = {}) {
    settings_.crop = crop;
    const Camera camera = look_at({4.f, 0.7f, 0.f}, {0.f, 0.f, 0.f}, 0.8f);
    auto film = render({&scene_, {&grey_, nullptr}, nullptr, camera}, settings_, diagnostics_,
                       control, &statistics_);
    EXPECT_TRUE(film) << diagnostics_.to_string();
    return film ? *std::move(film) : Film(1, 1);
  }

  Scene scene_;
  const LambertShader grey_{{0.6f, 0.3f, 1.f}};
  RenderSettings settings_;
  RenderStatistics statistics_;
  Diagnostics diagnostics_;
  TemporaryFolder folder_;
};

void expect_part(const Film& part, const Film& whole, const PixelWindow& window) {
  ASSERT_EQ(part.window(), window);
  ASSERT_EQ(part.width(), whole.width());
  ASSERT_EQ(part.pixels().size(), window.pixels());
  for_pixels(window, [&](int x, int y) {
    const Vec3 a = part.mean(x, y), b = whole.mean(x, y);
    EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z) << x << ' ' << y;
    EXPECT_EQ(part.variance(x, y).x, whole.variance(x, y).x);
    const std::size_t i = part.index(x, y), k = whole.index(x, y);
    for (std::size_t c = 0; c < whole.passes.planes.size(); ++c) {
      EXPECT_EQ(part.passes.planes[c][i], whole.passes.planes[c][k]) << whole.passes.channels[c];
    }
    const Mattes &mine = part.passes.mattes.at(0), &all = whole.passes.mattes.at(0);
    for (std::size_t c = 0; c < all.planes.size(); ++c) {
      EXPECT_EQ(mine.planes[c][i], all.planes[c][k]);
    }
  });
}

// Within a tile, over the edges of several, a row, the corner that is the image's, and all of it.
const PixelWindow windows[] = {
    {3, 5, 9, 8}, {10, 12, 37, 35}, {0, 39, 50, 40}, {49, 39, 50, 40}, {0, 0, 50, 40}};

TEST_F(Crop, HasTheBitsOfTheWholeAndTracesNothingElse) {
  const Film whole = film({});
  for (const PixelWindow& window : windows) {
    const Film part = film(window);
    expect_part(part, whole, window);
    EXPECT_EQ(statistics_.paths, window.pixels() * 32);
  }
}

// A tile that is cut is judged by all of its pixels.
TEST_F(Crop, HasThemWhereSamplesAreTakenUntilTheyAreEnough) {
  settings_.samples = 512;
  settings_.noise = 0.03;
  const Film whole = film({});
  ASSERT_LT(statistics_.least_samples, statistics_.most_samples);
  for (const PixelWindow& window : windows) expect_part(film(window), whole, window);
}

TEST_F(Crop, GoesOnFromACheckpoint) {
  const PixelWindow& window = windows[1];
  const Film whole = film({});
  std::stop_source enough;
  Checkpoint checkpoint(folder_.file("a.checkpoint"), "key", 1e9);
  enough.request_stop();
  double share = 0;
  film(window, {.enough = enough.get_token(),
                .progress = [&](double done) { share = done; },
                .checkpoint = &checkpoint});
  ASSERT_LT(statistics_.most_samples, settings_.samples);
  std::optional<double> first;
  const RenderControl control{.progress = [&](double done) { first = first.value_or(done); },
                              .checkpoint = &checkpoint};
  expect_part(film(window, control), whole, window);
  ASSERT_TRUE(first);
  EXPECT_GT(*first, share);  // It goes on from there, and does not begin anew.
  EXPECT_EQ(statistics_.paths, window.pixels() * 32);  // Of both runs: nothing twice.
}

}  // namespace
}  // namespace nacre::host
