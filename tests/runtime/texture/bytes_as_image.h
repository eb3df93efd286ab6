#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "runtime/texture/image_io.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {

/// Reads bytes as an image file.
class BytesAsImage : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  /// The code of the problem that a whole reading finds; "" if there is none.
  std::string code_of(const std::string& bytes, const ImageLimits& limits = {},
                      const Stop& stop = {}, const std::string& layer = "") {
    write_file(file("image"), bytes);
    ImageReader reader;
    pixels_.clear();
    auto problem = reader.open(file("image"), layer, limits, stop);
    if (!problem) {
      channels_ = reader.info().channels;
      const auto count = static_cast<std::size_t>(reader.info().width * channels_);
      problem = reader.read([&](int, const float* row) {
        for (std::size_t i = 0; i < count; ++i) {
          pixels_.push_back(static_cast<int>(std::lround(row[i] * 255)));
        }
      });
    }
    found_ = problem ? problem->to_string() : "";
    if (!problem) return "";
    EXPECT_EQ(problem->where.file, file("image"));
    return problem->code;
  }

  /// Of all channels, 0 to 255, from the top row down; none where there is a problem.
  std::vector<int> pixels_of(const std::string& bytes) {
    EXPECT_EQ(code_of(bytes), "") << found_;
    return pixels_;
  }

  TemporaryFolder folder_;
  std::string found_;
  std::vector<int> pixels_;
  int channels_ = 0;
};

}  // namespace nacre
