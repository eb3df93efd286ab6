#pragma once

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace nacre {

/// Samples row by row from the TOP, channels together.
struct TestImage {
  int width = 1;
  int height = 1;
  int channels = 1;
  std::vector<float> samples;

  /// y counts from the BOTTOM, as in the store.
  float& at(int x, int y, int c);
  float at(int x, int y, int c) const;
};

/// Samples at random in [0, 1], rounded to multiples of 1 / `steps`; the same for a seed.
TestImage random_image(int width, int height, int channels, int steps, unsigned seed = 1);

/// What a file can have beside its pixels.
struct WriteOptions {
  std::string type = "uint8";  ///< OpenImageIO's name: uint8, uint16, half, float.
  std::vector<std::string> channel_names;
  int tile = 0;    ///< Side of tiles; 0: scanlines.
  int data_x = 0;  ///< Origin of the data window in a larger display window.
  int data_y = 0;
  int full_width = 0;  ///< Of the display window, whose origin is (0, 0); 0: the data window.
  int full_height = 0;
};

/// Writes with OpenImageIO; the extension gives the format. False if that cannot be done.
bool write_image(const std::string& path, const TestImage& image, const WriteOptions& options = {});

/// One EXR of several named parts.
bool write_parts(const std::string& path, const std::vector<TestImage>& images,
                 const std::vector<std::string>& names);

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);

}  // namespace nacre
