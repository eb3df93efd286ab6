#include "tests/runtime/texture/test_image.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

namespace nacre {

namespace {

OIIO::ImageSpec make_spec(const TestImage& image, const WriteOptions& options) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc(options.type));
  spec["oiio:UnassociatedAlpha"] = 1;
  if (!options.channel_names.empty()) spec.channelnames = options.channel_names;
  spec.tile_width = spec.tile_height = options.tile;
  spec.x = options.data_x;
  spec.y = options.data_y;
  if (options.full_width != 0) {
    spec.full_width = options.full_width;
    spec.full_height = options.full_height;
  }
  return spec;
}

std::size_t index(const TestImage& image, int x, int y, int c) {
  return static_cast<std::size_t>(((image.height - 1 - y) * image.width + x) * image.channels + c);
}

}  // namespace

float& TestImage::at(int x, int y, int c) { return samples[index(*this, x, y, c)]; }
float TestImage::at(int x, int y, int c) const { return samples[index(*this, x, y, c)]; }

TestImage random_image(int width, int height, int channels, int steps, unsigned seed) {
  TestImage image{width, height, channels, {}};
  image.samples.resize(static_cast<std::size_t>(width * height * channels));
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> step(0, steps);
  for (float& sample : image.samples) {
    sample = static_cast<float>(step(generator)) / static_cast<float>(steps);
  }
  return image;
}

bool write_image(const std::string& path, const TestImage& image, const WriteOptions& options) {
  auto output = OIIO::ImageOutput::create(path);
  if (!output || !output->open(path, make_spec(image, options))) return false;
  return output->write_image(OIIO::TypeFloat, image.samples.data()) && output->close();
}

bool write_parts(const std::string& path, const std::vector<TestImage>& images,
                 const std::vector<std::string>& names) {
  auto output = OIIO::ImageOutput::create(path);
  if (!output) return false;
  std::vector<OIIO::ImageSpec> specs;
  for (std::size_t i = 0; i < images.size(); ++i) {
    WriteOptions options;
    options.type = "float";
    specs.push_back(make_spec(images[i], options));
    specs.back()["oiio:subimagename"] = names[i];
  }
  if (!output->open(path, static_cast<int>(specs.size()), specs.data())) return false;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (i > 0 && !output->open(path, specs[i], OIIO::ImageOutput::AppendSubimage)) return false;
    if (!output->write_image(OIIO::TypeFloat, images[i].samples.data())) return false;
  }
  return output->close();
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace nacre
