// PNG files as other readers see them: OpenImageIO's, and zlib with the chunks taken apart here.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/examples/encode/written_image.h"

namespace nacre::host {
namespace {

/// Numbers of all sizes, noise beside what is smooth.
Planes planes_of(int width, int height, std::size_t channels) {
  Planes planes(channels);
  Noise noise;
  for (std::size_t c = 0; c < channels; ++c) {
    for (int i = 0; i < width * height; ++i) {
      const float any = noise.next();
      planes[c].push_back(c == 1 ? any : static_cast<float>(i % width) / float(width));
    }
  }
  return planes;
}

class WrittenPng : public WrittenImage {};

ImageHeader header_of(int width, int height, std::size_t channels, SampleType samples) {
  return image_header(ImageKind::png, width, height, channels, samples);
}

TEST_F(WrittenPng, IsReadBack) {
  struct Size {
    int width, height;
  };
  for (const Size size : {Size{1, 1}, Size{3, 5}, Size{300, 257}, Size{40000, 2}}) {
    for (std::size_t channels = 1; channels <= 4; ++channels) {
      for (const SampleType samples : {SampleType::unsigned8, SampleType::unsigned16}) {
        const Planes planes = planes_of(size.width, size.height, channels);
        const std::string file =
            write(header_of(size.width, size.height, channels, samples), planes);
        OIIO::ImageSpec as_it_is;
        as_it_is.attribute("oiio:UnassociatedAlpha", 1);
        const auto in = OIIO::ImageInput::open(file, &as_it_is);
        ASSERT_NE(in, nullptr) << OIIO::geterror();
        ASSERT_EQ(in->spec().width, size.width);
        ASSERT_EQ(in->spec().height, size.height);
        ASSERT_EQ(in->spec().nchannels, static_cast<int>(channels));
        std::vector<std::uint16_t> words(planes[0].size() * channels);
        ASSERT_TRUE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT16, words.data()));
        const bool is_bytes = samples == SampleType::unsigned8;
        EXPECT_EQ(in->spec().format, is_bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
        for (std::size_t i = 0; i < words.size(); ++i) {
          const auto value = static_cast<double>(planes[i % channels][i / channels]);
          const double code = std::floor(value * (is_bytes ? 255.0 : 65535.0) + 0.5);
          ASSERT_EQ(words[i], code * (is_bytes ? 257.0 : 1.0));
        }
      }
    }
  }
}

// What a lenient reader may forgive: the CRC of each chunk, one zlib stream that ends with the
// right checksum, and nothing after it.
TEST_F(WrittenPng, IsOneStreamOfChunksThatAreRight) {
  const ImageHeader header = header_of(300, 257, 3, SampleType::unsigned8);
  const std::string file = write(header, planes_of(300, 257, 3));
  std::ifstream stream(file, std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), {}};
  std::vector<unsigned char> data;
  std::map<std::string, int> chunks;
  std::size_t at = 8;
  const auto number = [&](std::size_t place) {
    return std::uint32_t{bytes[place]} << 24 | std::uint32_t{bytes[place + 1]} << 16 |
           std::uint32_t{bytes[place + 2]} << 8 | std::uint32_t{bytes[place + 3]};
  };
  while (at + 12 <= bytes.size()) {
    const std::size_t length = number(at);
    const std::string letters(bytes.begin() + static_cast<std::ptrdiff_t>(at + 4),
                              bytes.begin() + static_cast<std::ptrdiff_t>(at + 8));
    ASSERT_LE(at + 12 + length, bytes.size());
    EXPECT_EQ(number(at + 8 + length),
              crc32(0, bytes.data() + at + 4, static_cast<uInt>(length + 4)));
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at + 8);
    if (letters == "IDAT")
      data.insert(data.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    ++chunks[letters];
    at += 12 + length;
  }
  EXPECT_EQ(at, bytes.size());
  EXPECT_GT(chunks["IDAT"], 20);  // Strips of their own.
  EXPECT_EQ(chunks["IEND"], 1);
  EXPECT_EQ(chunks["tIME"], 0);
  std::vector<unsigned char> rows(257 * (3 * 300 + 1));
  uLongf size = rows.size();
  uLong taken = data.size();
  EXPECT_EQ(uncompress2(rows.data(), &size, data.data(), &taken), Z_OK);
  EXPECT_EQ(size, rows.size());
  EXPECT_EQ(taken, data.size());
}

TEST_F(WrittenPng, SaysItsColourSpace) {
  const auto space_of = [&](const std::string& colorspace) {
    ImageHeader header = header_of(2, 2, 3, SampleType::unsigned8);
    header.colorspace = colorspace;
    const auto in = OIIO::ImageInput::open(write(header, planes_of(2, 2, 3)));
    return std::string(in->spec().get_string_attribute("oiio:ColorSpace"));
  };
  for (const std::string space : {"sRGB", "Linear", "acescg"}) EXPECT_EQ(space_of(space), space);
}

TEST_F(WrittenPng, CodesColoursAndNeverAlpha) {
  ImageHeader header = header_of(1, 1, 4, SampleType::unsigned8);
  header.codes_srgb = true;
  const std::string file = write(header, {{0.5f}, {0.0f}, {1.0f}, {0.5f}});
  OIIO::ImageSpec as_it_is;
  as_it_is.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(file, &as_it_is);
  std::vector<std::uint8_t> texel(4);
  ASSERT_TRUE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, texel.data()));
  EXPECT_EQ(texel, (std::vector<std::uint8_t>{188, 0, 255, 128}));
}

TEST_F(WrittenPng, RefusesWhatItCannotHold) {
  std::string problem;
  EXPECT_EQ(open_image(folder_.file("a.png"), header_of(2, 2, 3, SampleType::half), problem),
            nullptr);
  EXPECT_NE(problem, "");
}

}  // namespace
}  // namespace nacre::host
