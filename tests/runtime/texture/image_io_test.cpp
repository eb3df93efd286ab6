#include "runtime/texture/image_io.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

#include "runtime/texture/image_format.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

class ImageIo : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  /// Opens and reads all; y counts from the bottom as in TestImage::at.
  TestImage read(const std::string& path, const std::string& layer = {}) {
    ImageReader reader;
    if (const auto problem = reader.open(path, layer, {})) {
      ADD_FAILURE() << problem->to_string();
      return {};
    }
    info_ = reader.info();
    expect_look(path, layer);
    TestImage image{info_.width, info_.height, info_.channels, {}};
    int next = 0;
    const auto problem = reader.read([&](int y, const float* samples) {
      EXPECT_EQ(y, next++);
      image.samples.insert(image.samples.end(), samples, samples + image.width * image.channels);
    });
    EXPECT_FALSE(problem.has_value());
    EXPECT_EQ(next, info_.height);
    return image;
  }

  /// The header alone says the same.
  void expect_look(const std::string& path, const std::string& layer) const {
    ImageReader reader;
    if (const auto problem = reader.look(path, layer, {})) {
      ADD_FAILURE() << problem->to_string();
      return;
    }
    const ImageInfo& seen = reader.info();
    EXPECT_EQ(seen.width, info_.width) << path;
    EXPECT_EQ(seen.height, info_.height) << path;
    EXPECT_EQ(seen.channels, info_.channels) << path;
    EXPECT_EQ(seen.first_channel, info_.first_channel) << path;
    EXPECT_EQ(seen.subimage, info_.subimage) << path;
    EXPECT_EQ(seen.samples, info_.samples) << path;
    EXPECT_EQ(seen.file, info_.file) << path;
  }

  std::string code_of(const std::string& path, const std::string& layer = {},
                      const ImageLimits& limits = {}) {
    ImageReader reader;
    const auto problem = reader.open(path, layer, limits);
    if (problem) {
      EXPECT_EQ(problem->where.file, path);
    }
    return problem ? problem->code : "";
  }

  TemporaryFolder folder_;
  ImageInfo info_;
};

TEST_F(ImageIo, ReadsWhatWasWrittenInEveryFormat) {
  struct Case {
    const char* name;
    const char* type;
    int channels;
    int steps;
    SampleType samples;
  };
  for (const Case& one : {Case{"a.png", "uint8", 1, 255, SampleType::unsigned8},
                          Case{"b.png", "uint8", 2, 255, SampleType::unsigned8},
                          Case{"c.png", "uint8", 4, 255, SampleType::unsigned8},
                          Case{"d.png", "uint16", 3, 65535, SampleType::unsigned16},
                          Case{"e.tif", "uint8", 3, 255, SampleType::unsigned8},
                          Case{"f.tif", "uint16", 4, 65535, SampleType::unsigned16},
                          Case{"g.tif", "float", 3, 1 << 20, SampleType::floating},
                          Case{"h.exr", "half", 4, 1024, SampleType::half},
                          Case{"i.exr", "float", 2, 1 << 20, SampleType::floating},
                          Case{"j.tga", "uint8", 4, 255, SampleType::unsigned8},
                          Case{"l.hdr", "float", 3, 2, SampleType::floating}}) {
    const TestImage image = random_image(17, 5, one.channels, one.steps);
    WriteOptions options;
    options.type = one.type;
    ASSERT_TRUE(write_image(file(one.name), image, options)) << one.name;
    const TestImage back = read(file(one.name));
    EXPECT_EQ(info_.samples, one.samples) << one.name;
    ASSERT_EQ(back.channels, image.channels) << one.name;
    ASSERT_EQ(back.samples.size(), image.samples.size()) << one.name;
    for (std::size_t i = 0; i < image.samples.size(); ++i) {
      // The writer may store k/steps in a neighbouring float; integers must come back.
      ASSERT_NEAR(back.samples[i], image.samples[i], 1e-6) << one.name << " sample " << i;
    }
  }
}

TEST_F(ImageIo, TiledFilesReadLikeScanlines) {
  for (const char* name : {"a.exr", "a.tif"}) {
    const TestImage image = random_image(70, 45, 3, 255);
    WriteOptions options;
    options.type = "float";
    options.tile = 32;
    ASSERT_TRUE(write_image(file(name), image, options));
    EXPECT_EQ(read(file(name)).samples, image.samples);
  }
}

TEST_F(ImageIo, AlphaIsNotMultipliedIn) {
  TestImage image = random_image(1, 1, 4, 255);
  image.samples = {1.f, 0.f, 1.f, 0.f};
  for (const char* name : {"a.png", "a.tif", "a.tga"}) {
    ASSERT_TRUE(write_image(file(name), image));
    EXPECT_EQ(read(file(name)).samples, image.samples) << name;
  }
}

TEST_F(ImageIo, DataWindowSitsInABlackDisplayWindow) {
  const TestImage image = random_image(3, 2, 1, 255);
  WriteOptions options;
  options.type = "float";
  options.data_x = 2;
  options.data_y = 1;
  options.full_width = 6;
  options.full_height = 5;
  ASSERT_TRUE(write_image(file("a.exr"), image, options));
  const TestImage back = read(file("a.exr"));
  ASSERT_EQ(back.width, 6);
  ASSERT_EQ(back.height, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool inside = x >= 2 && x < 5 && y >= 2 && y < 4;  // From the bottom.
      EXPECT_EQ(back.at(x, y, 0), inside ? image.at(x - 2, y - 2, 0) : 0.f) << x << "," << y;
    }
  }
}

TEST_F(ImageIo, OverscanIsCutOff) {
  const TestImage image = random_image(8, 8, 1, 255);
  WriteOptions options;
  options.type = "float";
  options.data_x = -2;
  options.data_y = -3;
  options.full_width = 4;
  options.full_height = 4;
  ASSERT_TRUE(write_image(file("a.exr"), image, options));
  const TestImage back = read(file("a.exr"));
  ASSERT_EQ(back.samples.size(), 16u);
  for (int y = 0; y < 4; ++y) {  // From the top, display row y is data row y + 3.
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(back.at(x, 3 - y, 0), image.at(x + 2, 7 - (y + 3), 0));
    }
  }
}

TEST_F(ImageIo, LayerIsASubimageByName) {
  const std::vector<TestImage> parts{random_image(4, 4, 3, 255, 1), random_image(4, 4, 3, 255, 2)};
  ASSERT_TRUE(write_parts(file("a.exr"), parts, {"beauty", "albedo"}));
  EXPECT_EQ(read(file("a.exr")).samples, parts[0].samples);
  EXPECT_EQ(read(file("a.exr"), "albedo").samples, parts[1].samples);
  EXPECT_EQ(read(file("a.exr"), "1").samples, parts[1].samples);
  EXPECT_EQ(code_of(file("a.exr"), "normal"), "unknown-image-layer");
  EXPECT_EQ(code_of(file("a.exr"), "2"), "unknown-image-layer");
  ImageReader reader;
  const auto problem = reader.open(file("a.exr"), "albdeo", {});
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->hint, "did you mean 'albedo'?");
}

TEST_F(ImageIo, LayerIsAPageByNumber) {
  const std::vector<TestImage> pages{random_image(4, 4, 3, 255, 1), random_image(5, 3, 3, 255, 2),
                                     random_image(2, 2, 3, 255, 3)};
  ASSERT_TRUE(write_parts(file("a.tif"), pages, {"", "", ""}));
  EXPECT_EQ(read(file("a.tif")).samples, pages[0].samples);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    EXPECT_EQ(read(file("a.tif"), std::to_string(i)).samples, pages[i].samples);
  }
  for (const char* wrong : {"3", "-1", "1.5", "99999999999"}) {
    EXPECT_EQ(code_of(file("a.tif"), wrong), "unknown-image-layer");
  }
  // A file of one image has its number too, whatever the format.
  for (const char* name : {"a.png", "a.jpg", "a.tga"}) {
    ASSERT_TRUE(write_image(file(name), random_image(4, 4, 3, 255)));
    EXPECT_EQ(read(file(name), "0").samples, read(file(name)).samples);
    EXPECT_EQ(code_of(file(name), "1"), "unknown-image-layer");
  }
}

TEST_F(ImageIo, LayerIsAGroupOfChannelsByPrefix) {
  const TestImage image = random_image(4, 4, 6, 255);
  WriteOptions options;
  options.type = "float";
  options.channel_names = {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B"};
  ASSERT_TRUE(write_image(file("a.exr"), image, options));
  const TestImage first = read(file("a.exr"));
  const TestImage albedo = read(file("a.exr"), "albedo");
  ASSERT_EQ(first.channels, 3);
  ASSERT_EQ(albedo.channels, 3);
  EXPECT_EQ(first.at(2, 1, 1), image.at(2, 1, 1));
  EXPECT_EQ(albedo.at(2, 1, 1), image.at(2, 1, 4));
}

TEST_F(ImageIo, DepthIsNotTakenForAlpha) {
  const TestImage image = random_image(2, 2, 4, 255);
  WriteOptions options;
  options.type = "float";
  options.channel_names = {"R", "G", "B", "Z"};
  ASSERT_TRUE(write_image(file("a.exr"), image, options));
  EXPECT_EQ(read(file("a.exr")).channels, 3);
}

TEST_F(ImageIo, ContentDecidesTheFormatNotTheName) {
  ASSERT_TRUE(write_image(file("a.jpg"), random_image(16, 16, 3, 255)));
  write_file(file("b.png"), read_file(file("a.jpg")));
  EXPECT_EQ(read(file("b.png")).samples, read(file("a.jpg")).samples);
}

TEST_F(ImageIo, OtherFormatsAreRefusedByName) {
  write_file(file("a.png"), "this is not a picture");
  write_file(file("b.ppm"), "P6\n1 1\n255\nabc");
  write_file(file("c.svg"), "<svg xmlns='http://www.w3.org/2000/svg'/>");
  for (const char* name : {"a.png", "b.ppm", "c.svg"}) {
    EXPECT_EQ(code_of(file(name)), "unsupported-image");
  }
  write_file(file("d.png"), "");
  EXPECT_EQ(code_of(file("d.png")), "unreadable-image");
  EXPECT_EQ(code_of(folder_.path().string()), "unreadable-image");
  EXPECT_EQ(code_of("/dev/zero"), "unreadable-image");
  EXPECT_EQ(code_of(file("nowhere.png")), "missing-image");
}

TEST_F(ImageIo, LimitsHold) {
  ASSERT_TRUE(write_image(file("a.png"), random_image(40, 30, 3, 255)));
  const auto with = [](auto member, auto value) {
    ImageLimits limits;
    limits.*member = value;
    return limits;
  };
  const std::uint64_t file_bytes = read_file(file("a.png")).size();
  EXPECT_EQ(code_of(file("a.png"), "", with(&ImageLimits::max_size, 40)), "");
  EXPECT_EQ(code_of(file("a.png"), "", with(&ImageLimits::max_size, 39)), "image-too-large");
  EXPECT_EQ(code_of(file("a.png"), "", with(&ImageLimits::max_bytes, 3600)), "");
  EXPECT_EQ(code_of(file("a.png"), "", with(&ImageLimits::max_bytes, 3599)), "image-too-large");
  EXPECT_EQ(code_of(file("a.png"), "", with(&ImageLimits::max_file_bytes, file_bytes)), "");
  EXPECT_EQ(code_of(file("a.png"), "", with(&ImageLimits::max_file_bytes, file_bytes - 1)),
            "image-too-large");
}

// What the header says is held against the limits, and known where the pixels are cut off.
TEST_F(ImageIo, ALookEndsWithTheHeader) {
  for (const char* name : {"a.png", "a.jpg", "a.tga", "a.bmp", "a.exr", "a.tif"}) {
    ASSERT_TRUE(write_image(file(name), random_image(64, 48, 3, 255)));
    const std::string whole = read_file(file(name));
    ImageLimits small;
    small.max_size = 63;
    ImageReader reader;
    auto problem = reader.look(file(name), "", small);
    ASSERT_TRUE(problem) << name;
    EXPECT_EQ(problem->code, "image-too-large") << name;
    write_file(file(name), whole.substr(0, 16));
    EXPECT_TRUE(reader.look(file(name), "", {})) << name;
  }
  for (const char* name : {"b.png", "b.jpg"}) {
    ASSERT_TRUE(write_image(file(name), random_image(64, 48, 3, 255)));
    const std::string whole = read_file(file(name));
    write_file(file(name), whole.substr(0, whole.size() - 500));
    ImageReader reader;
    EXPECT_TRUE(reader.open(file(name), "", {})) << name;
    EXPECT_FALSE(reader.look(file(name), "", {})) << name;
    EXPECT_EQ(reader.info().width, 64) << name;
  }
}

/// Who comes first loads what reads images, the others wait for it.
TEST_F(ImageIo, TheFirstImageByManyThreads) {
  const TestImage image = random_image(5, 7, 3, 1);
  ASSERT_TRUE(write_image(file("a.png"), image));
  std::array<std::vector<float>, 8> read;
  {
    std::vector<std::jthread> threads;
    for (std::vector<float>& samples : read) {
      threads.emplace_back([&samples, path = file("a.png")] {
        ImageReader reader;
        if (reader.open(path, "", {})) return;
        (void)reader.read(
            [&](int, const float* row) { samples.insert(samples.end(), row, row + 15); });
      });
    }
  }
  for (const std::vector<float>& samples : read) EXPECT_EQ(samples, image.samples);
}

}  // namespace
}  // namespace nacre
