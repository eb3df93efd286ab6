#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "examples/common/image_writer.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {

using Planes = std::vector<std::vector<float>>;

/// From 0 to 1 and of no order, the same each time.
class Noise {
 public:
  float next() {
    seed_ = seed_ * 1664525u + 1013904223u;
    return static_cast<float>(seed_ >> 8) / float(1 << 24);
  }

 private:
  std::uint32_t seed_ = 7;
};

/// Of up to four channels R, G, B, A, or of nine.
inline ImageHeader image_header(ImageKind kind, int width, int height, std::size_t channels,
                                SampleType samples) {
  std::vector<std::string> names{"R", "G", "B", "A"};
  if (channels > 4) names = {"m0", "m1", "m2", "m3", "m4", "m5", "m6", "m7", "m8"};
  names.resize(channels);
  ImageHeader header;
  header.kind = kind;
  header.width = width;
  header.height = height;
  header.channels = std::move(names);
  header.samples = samples;
  header.colorspace = "Linear";
  return header;
}

/// Files in a folder of the test's own.
class WrittenImage : public ::testing::Test {
 protected:
  /// The file that holds the planes.
  std::string write(const ImageHeader& header, const Planes& planes) {
    const std::string file = folder_.file(header.kind == ImageKind::png ? "a.png" : "a.exr");
    std::string problem;
    const auto image = open_image(file, header, problem);
    EXPECT_NE(image, nullptr) << problem;
    EXPECT_EQ(write_planes(*image, header, planes), "");
    return file;
  }

  TemporaryFolder folder_;
};

}  // namespace nacre::host
