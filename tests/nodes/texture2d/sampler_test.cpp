#include "nodes/texture2d/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/nodes/texture2d/lookups.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

constexpr std::array filters{TextureFilter::closest, TextureFilter::linear, TextureFilter::cubic};
constexpr std::array modes{AddressMode::constant, AddressMode::clamp, AddressMode::periodic,
                           AddressMode::mirror};
constexpr std::array<float, 4> fallback{0.125f, 0.25f, 0.75f, 0.5f};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

struct Format {
  const char* name;
  const char* file;
  const char* type;
  int channels;
  int steps;          ///< Of the random samples.
  double level_step;  ///< Half of what a coarser level is rounded to, for values in [0, 1].
};

// One of each texel format of the store, and fewer channels than the format keeps.
const std::array formats{
    Format{"rgba8", "a.png", "uint8", 4, 255, 0.5 / 255},
    Format{"rgb8", "b.png", "uint8", 3, 255, 0.5 / 255},
    Format{"r32f", "c.exr", "float", 1, 1 << 20, 0x1p-24},
    Format{"rgba16", "d.png", "uint16", 4, 65535, 0.5 / 65535},
    Format{"rg16f", "e.exr", "half", 2, 1024, 0x1p-12},
    Format{"rgba16f", "f.exr", "half", 4, 1024, 0x1p-12},
    Format{"rgba32f", "g.exr", "float", 4, 1 << 20, 0x1p-24},
};
constexpr std::array<std::pair<int, int>, 7> sizes{
    {{1, 1}, {2, 2}, {1, 5}, {3, 1}, {8, 8}, {13, 7}, {61, 33}}};

/// Error of a position, in texels, from rounding uv and its product with the size:
/// filters change by at most the range of the texels (1) for one texel along an axis.
double position_error(int width, int height) { return 0x1p-23 * (width + height) + 4e-7; }

class SamplerTest : public testing::Test {
 protected:
  void write(const Format& format, int width, int height) {
    WriteOptions options;
    options.type = format.type;
    path_ = folder_.file(std::to_string(width) + 'x' + std::to_string(height) + format.file);
    ASSERT_TRUE(
        write_image(path_, random_image(width, height, format.channels, format.steps), options));
    reference_ = ReferenceSampler::open(path_);
    ASSERT_TRUE(reference_.has_value());
  }

  RecordedLookup record(TextureStore& store, const TextureModes& mode, int channels = 4) const {
    return RecordedLookup(store, [&](Recorder& recorder, TextureProvider& textures, Float2 uv) {
      const ImageLookup lookup{.uv = uv,
                               .modes = mode,
                               .channels = channels,
                               .otherwise = {fallback[0], fallback[1], fallback[2], fallback[3]}};
      TextureSources sources = textures.find(path_, "");
      sources.max_anisotropy = mode.max_anisotropy;
      return sample_images(recorder, sources, lookup);
    });
  }

  Rgba64 exact(const LookupPoints& points, std::size_t i, const TextureModes& mode,
               double shift_u = 0, double shift_v = 0) const {
    return reference_->sample(points.u[i] + shift_u, points.v[i] + shift_v, points.footprint(i),
                              {mode.filter, mode.u, mode.v, mode.max_anisotropy},
                              {fallback[0], fallback[1], fallback[2], fallback[3]});
  }

  static double distance(const std::array<float, 4>& a, const Rgba64& b) {
    double worst = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double error = std::fabs(a[c] - b[c]);
      if (!(error <= worst)) worst = error;
    }
    return worst;
  }

  /// For `closest`: a point within rounding of the border of two texels may take either.
  double closest_distance(const std::array<float, 4>& value, const LookupPoints& points,
                          std::size_t i, const TextureModes& mode) const {
    double best = distance(value, exact(points, i, mode));
    for (const double u : {-1e-7, 1e-7}) {
      for (const double v : {-1e-7, 1e-7}) {
        best = std::min(best, distance(value, exact(points, i, mode, u, v)));
      }
    }
    return best;
  }

  void expect_close(const LookupPoints& points, const TextureModes& mode, double tolerance) {
    TextureStore store;
    const RecordedLookup lookup = record(store, mode);
    const auto values = lookup.run(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double error = mode.filter == TextureFilter::closest
                               ? closest_distance(values[i], points, i, mode)
                               : distance(values[i], exact(points, i, mode));
      ASSERT_LE(error, tolerance) << path_ << " filter " << static_cast<int>(mode.filter)
                                  << " modes " << static_cast<int>(mode.u)
                                  << static_cast<int>(mode.v) << " at " << points.u[i] << ", "
                                  << points.v[i] << " footprint " << points.dudx[i] << ' '
                                  << points.dvdx[i] << ' ' << points.dudy[i] << ' '
                                  << points.dvdy[i];
    }
  }

  TemporaryFolder folder_;
  std::string path_;
  std::optional<ReferenceSampler> reference_;
};

TEST_F(SamplerTest, EdgesOfEveryFormatFilterAndMode) {
  for (const Format& format : formats) {
    for (const auto& [width, height] : sizes) {
      write(format, width, height);
      const LookupPoints points = edge_points(width, height);
      for (const TextureFilter filter : filters) {
        for (const AddressMode mode : modes) {
          expect_close(points, {filter, mode, mode}, position_error(width, height));
        }
      }
    }
  }
}

TEST_F(SamplerTest, FootprintsOfEveryFormatFilterAndMode) {
  for (const Format& format : formats) {
    for (const auto& [width, height] : {std::pair{13, 7}, std::pair{61, 33}, std::pair{1, 5}}) {
      write(format, width, height);
      const LookupPoints points = random_points(1500, width, height, 3);
      for (const TextureFilter filter : filters) {
        for (const AddressMode mode : modes) {
          // Besides: the rounding of the blend, and that of coarser levels.
          expect_close(points, {filter, mode, mode},
                       position_error(width, height) + format.level_step + 3e-6);
        }
      }
    }
  }
}

TEST_F(SamplerTest, LongFootprintsTakeSeveralProbes) {
  for (const Format& format : {formats[0], formats[2], formats[6]}) {
    write(format, 61, 33);
    const LookupPoints points = random_points(300, 61, 33, 7);
    for (const TextureFilter filter : filters) {
      for (const AddressMode mode : modes) {
        for (const int most : {2, 5, 32}) {
          // Besides: half an ulp of a position of up to 3 images, at each probe.
          expect_close(points, {filter, mode, mode, most},
                       2 * position_error(61, 33) + format.level_step + 3e-6);
        }
      }
    }
  }
}

TEST_F(SamplerTest, AxesHaveTheirOwnModes) {
  write(formats[0], 13, 7);
  const LookupPoints points = random_points(1000, 13, 7, 4);
  for (const AddressMode u : modes) {
    for (const AddressMode v : modes) {
      expect_close(points, {TextureFilter::linear, u, v},
                   position_error(13, 7) + formats[0].level_step + 3e-6);
    }
  }
}

// A huge one is the last level; one that is not a number counts as none.
TEST_F(SamplerTest, FootprintsOfAnySize) {
  write(formats[6], 61, 33);
  LookupPoints points;
  for (const float d : {0.0f, 1e-30f, 1.0f / 61, 1e10f, 1e30f, 3e38f}) {
    points.add(0.3f, 0.7f, {d, 0, 0, 0});
    points.add(0.3f, 0.7f, {0, d, d, -d});
  }
  LookupPoints without = points;
  points.add(0.3f, 0.7f, {nan, 0, 0, 0});
  points.add(0.3f, 0.7f, {nan, 1e10f, 0, nan});
  without.add(0.3f, 0.7f);
  without.add(0.3f, 0.7f);
  TextureStore store;
  for (const int most : {1, 32}) {
    const TextureModes filtering{.max_anisotropy = most};
    const auto values = record(store, filtering).run(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LE(distance(values[i], exact(without, i, filtering)), 2e-5) << i << ' ' << most;
    }
  }
}

TEST_F(SamplerTest, OnlyWhatTheResultNeedsIsComputed) {
  write(formats[0], 13, 7);
  const LookupPoints points = random_points(200, 13, 7, 5);
  TextureStore store;
  const auto all = record(store, {}).run(points);
  for (int channels = 1; channels < 4; ++channels) {
    const auto some = record(store, {}, channels).run(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(some[i][c], c < static_cast<std::size_t>(channels) ? all[i][c] : 0.0f);
      }
    }
  }
}

TEST_F(SamplerTest, ClosestAndSingleTexelsNeedNoFootprint) {
  TextureStore store;
  write(formats[0], 13, 7);
  EXPECT_TRUE(record(store, {}).reads("duv0dx.x"));
  EXPECT_FALSE(record(store, {TextureFilter::closest}).reads("duv0dx.x"));
  write(formats[0], 1, 1);
  EXPECT_FALSE(record(store, {}).reads("duv0dx.x"));
  EXPECT_FALSE(record(store, {}).reads("uv0.x"));
}

// But for one texel, beyond the reach of what is looked up: else nothing would be.
TEST_F(SamplerTest, FlatImagesAreExactlyFlat) {
  for (const Format& format : formats) {
    TestImage image{64, 64, format.channels, {}};
    image.samples.assign(static_cast<std::size_t>(64 * 64 * format.channels), 1.0f);
    for (int c = 0; c < format.channels; ++c) image.at(63, 63, c) = 0.0f;
    WriteOptions options;
    options.type = format.type;
    path_ = folder_.file(std::string("flat") + format.file);
    ASSERT_TRUE(write_image(path_, image, options));
    TextureStore store;
    LookupPoints points;
    for (float turn = 0; turn < 6.3f; turn += 0.01f) {
      // Probes reach an eighth of the image, and levels as coarse as a sixteenth.
      points.add(0.3f + 0.02f * std::cos(turn), 0.3f + 0.02f * std::sin(turn),
                 {0.1f * std::cos(turn), 0.1f * std::sin(turn), 0.01f * turn, 0.03f});
    }
    const TextureModes long_ones{.max_anisotropy = 8};
    for (const auto& value : record(store, long_ones).run(points)) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(format.channels); ++c) {
        ASSERT_EQ(value[c], 1.0f) << format.name;
      }
    }
  }
}

// What is the same in all texels is not looked up, and has the bits of a look-up: that of an image
// of the host's, which may be another one later.
TEST_F(SamplerTest, UniformChannelsAreWhatALookUpGives) {
  constexpr int width = 20, height = 12;
  std::vector<float> samples;
  for (const TestImage noise = random_image(width, height, 4, 1024);
       const float x : noise.samples) {
    const std::size_t channel = samples.size() % 4;
    samples.push_back(channel == 1 ? 0.3f : channel == 3 ? 1.0f : x);
  }
  const TestImage image{width, height, 4, samples};
  path_ = folder_.file("uniform.exr");
  WriteOptions floats;
  floats.type = "float";
  ASSERT_TRUE(write_image(path_, image, floats));
  // The first row of a file is the upper one, as here.
  const Pixels pixels{.width = width,
                      .height = height,
                      .channels = 4,
                      .samples = SampleType::floating,
                      .data = samples.data()};
  for (const TextureFilter filter : filters) {
    for (const AddressMode mode : modes) {
      const TextureModes both{filter, mode, mode, 8};
      TextureStore files, memory;
      Diagnostics diagnostics;
      ASSERT_TRUE(memory.set_image(path_, pixels, diagnostics)) << diagnostics.to_string();
      const RecordedLookup known = record(files, both), general = record(memory, both);
      EXPECT_LT(known.program().entry().code.size(), general.program().entry().code.size());
      const LookupPoints points = random_points(500, width, height, 8);
      const auto found = known.run(points), expected = general.run(points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
          // Weights of a spline add up to 1 but for rounding.
          const bool is_rounded = filter == TextureFilter::cubic && c % 2 == 1;
          ASSERT_NEAR(found[i][c], expected[i][c], is_rounded ? 3e-7f : 0.0f)
              << static_cast<int>(filter) << static_cast<int>(mode) << ' ' << i << ' ' << c;
        }
      }
    }
  }
}

TEST_F(SamplerTest, HostGivesWhatIsResident) {
  for (const Format& format : formats) {
    write(format, 61, 33);
    LookupPoints points = edge_points(61, 33);
    // Several probes on level 0: coarser ones the cache rounds otherwise.
    for (float turn = 0; turn < 6.3f; turn += 0.1f) {
      const std::array footprint{6 * std::cos(turn) / 61, 6 * std::sin(turn) / 33, 0.01f, 0.0f};
      points.add(turn - 3, 0.3f + turn, footprint);
    }
    for (const TextureFilter filter : filters) {
      for (const AddressMode mode : modes) {
        TextureOptions none_resident;
        none_resident.budget = 0;
        TextureStore resident;
        TextureStore host(none_resident);
        const TextureModes both{filter, mode, mode, 8};
        const auto a = record(resident, both).run(points);
        const RecordedLookup tiled = record(host, both);
        const auto b = tiled.run(points);
        ASSERT_EQ(host.statistics().tiled_textures, 1u) << tiled.diagnostics().to_string();
        for (std::size_t i = 0; i < points.size(); ++i) {
          for (std::size_t c = 0; c < 4; ++c) {
            ASSERT_NEAR(a[i][c], b[i][c], 2e-6)
                << format.name << ' ' << static_cast<int>(filter) << static_cast<int>(mode)
                << " at " << points.u[i] << ", " << points.v[i];
          }
        }
      }
    }
  }
}

TEST_F(SamplerTest, MissingImageIsTheDefault) {
  path_ = folder_.file("absent.png");
  TextureStore store;
  const RecordedLookup lookup = record(store, {});
  EXPECT_EQ(lookup.diagnostics().error_count() + lookup.diagnostics().warning_count(), 1u);
  EXPECT_TRUE(lookup.inputs().empty());
  EXPECT_EQ(lookup.run(random_points(1, 1, 1, 1)).front(), fallback);
}

// The derivative of a recorded look-up is that of the filter, on one level or two, at the
// footprint it has.
TEST_F(SamplerTest, DerivativeIsThatOfTheFilter) {
  write(formats[6], 13, 7);
  TextureStore store;
  const RecordedLookup slope(store, [&](Recorder& recorder, TextureProvider& textures, Float2 uv) {
    const Float4 value = sample_images(recorder, textures.find(path_, ""), {.uv = uv});
    return Float4{footprint_derivative(value.x, 0), footprint_derivative(value.x, 1), 0.0f, 0.0f};
  });
  const TextureModes filtering{.max_anisotropy = default_anisotropy};
  for (const float d : {0.01f, 0.2f}) {
    LookupPoints points;
    for (float u = -1.0f; u < 2.0f; u += 0.0713f) points.add(u, 0.37f, {d, 0, 0, 2 * d});
    const auto values = slope.run(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      constexpr double step = 1e-6;
      const double along_u =
          (exact(points, i, filtering, step)[0] - exact(points, i, filtering, -step)[0]) /
          (2 * step);
      const double along_v =
          (exact(points, i, filtering, 0, step)[0] - exact(points, i, filtering, 0, -step)[0]) /
          (2 * step);
      EXPECT_NEAR(values[i][0], d * along_u, 1e-3 * d) << points.u[i];
      EXPECT_NEAR(values[i][1], 2 * d * along_v, 2e-3 * d) << points.u[i];
    }
  }
}

}  // namespace
}  // namespace nacre
