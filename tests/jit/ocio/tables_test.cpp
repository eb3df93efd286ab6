// Look-up tables: files that the test writes, and OpenColorIO's table transforms.
#include <fmt/format.h>

#include <cmath>

#include "tests/jit/ocio/config_fixture.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

namespace ocio = OCIO_NAMESPACE;

constexpr double roundings(int count) { return count * 0x1p-24; }

ocio::ConstTransformRcPtr file(const char* name,
                               ocio::Interpolation interpolation = ocio::INTERP_LINEAR) {
  const auto made = ocio::FileTransform::Create();
  made->setSrc(name);
  made->setInterpolation(interpolation);
  return made;
}

/// A curve over [0, 1] that is no straight line between any three entries.
double curve(double x, int channel) { return std::pow(x, 1.5 + 0.3 * channel) + 0.02 * channel; }

/// Sony Imageworks' format: entries over the domain from `low` to `high`.
std::string spi1d(int entries, double low, double high, int channels) {
  std::string text = fmt::format("Version 1\nFrom {} {}\nLength {}\nComponents {}\n{{\n", low, high,
                                 entries, channels);
  for (int i = 0; i < entries; ++i) {
    for (int k = 0; k < channels; ++k)
      text += fmt::format(" {:.9g}", curve(i / (entries - 1.0), k));
    text += '\n';
  }
  return text + "}\n";
}

/// Iridas' format, red fastest; every node its own random number.
std::string cube(int edge) {
  Random random(11);
  std::string text = fmt::format("LUT_3D_SIZE {}\n", edge);
  for (int i = 0; i < edge * edge * edge; ++i) {
    for (int k = 0; k < 3; ++k) {
      text += fmt::format(" {:.9g}", static_cast<double>(random.word() >> 11) * 0x1p-53);
    }
    text += '\n';
  }
  return text;
}

class Tables : public Config {};

// Texts find an entry by a number of texels' widths, which rounds it by some units in the
// last place of a number near 1: so many entries, and so much of the step to the next.

TEST_F(Tables, OfOneDimension) {
  folder_.write("one.spi1d", spi1d(33, 0, 1, 1));
  folder_.write("three.spi1d", spi1d(1024, -0.25, 1.5, 3));
  folder_.write("long.spi1d", spi1d(9000, 0, 1, 3));
  open({{"one", file("one.spi1d")}, {"three", file("three.spi1d")}, {"long", file("long.spi1d")}});
  // The steepest step of the curves is 2.1 / entries, in a domain of up to 1.75: the
  // rounded place moves the result by no more than the place itself is rounded.
  expect_agreement(colors(), "one", "linear", roundings(16));
  expect_agreement(colors(), "three", "linear", roundings(16));
  expect_agreement(colors(), "long", "linear", roundings(16));
}

TEST_F(Tables, OfThreeDimensions) {
  folder_.write("small.cube", cube(2));
  folder_.write("middle.cube", cube(17));
  folder_.write("large.cube", cube(33));
  open({{"small", file("small.cube")},
        {"linear 17", file("middle.cube")},
        {"tetrahedral 17", file("middle.cube", ocio::INTERP_TETRAHEDRAL)},
        {"linear 33", file("large.cube")},
        {"tetrahedral 33", file("large.cube", ocio::INTERP_TETRAHEDRAL)}});
  // Steps between nodes are as large as 1: per axis the place is rounded some four times,
  // in units of edge / 2^24.
  expect_agreement(colors(), "small", "linear", roundings(3 * 4 * 2));
  expect_agreement(colors(), "linear 17", "linear", roundings(3 * 4 * 17));
  expect_agreement(colors(), "tetrahedral 17", "linear", roundings(3 * 4 * 17));
  expect_agreement(colors(), "linear 33", "linear", roundings(3 * 4 * 33));
  expect_agreement(colors(), "tetrahedral 33", "linear", roundings(3 * 4 * 33));
}

float half_to_float(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const auto fraction = static_cast<float>(bits & 1023);
  const float size =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -size : size;
}

/// One entry for each half float; Academy and ASC Common LUT Format, S-2014-006.
TEST_F(Tables, OverHalfFloats) {
  std::string text =
      "<ProcessList id=\"half\" compCLFversion=\"3\"><LUT1D inBitDepth=\"32f\" "
      "outBitDepth=\"32f\" halfDomain=\"true\"><Array dim=\"65536 1\">\n";
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const float x = half_to_float(bits);
    // What comes behind the largest number is no number of the table.
    text += (bits & 0x7fff) < 0x7c00 ? fmt::format("{:.9g}\n", std::sinh(0.9f * std::asinh(x)))
                                     : std::string((bits & 0x8000) != 0 ? "-inf\n" : "inf\n");
  }
  folder_.write("half.clf", text + "</Array></LUT1D></ProcessList>\n");
  open({{"half", file("half.clf")}});
  expect_agreement(colors(), "half", "linear", roundings(64));
}

/// There by a table, back by the one that OpenColorIO makes for graphics cards: not exact,
/// but as good as its number of entries, 4096.
TEST_F(Tables, InverseTablesGoBack) {
  folder_.write("one.spi1d", spi1d(257, 0, 1, 3));
  open({{"one", file("one.spi1d")}});
  std::vector<Rgba> inside;
  for (const Rgba& color : colors()) {
    if (std::min({color[0], color[1], color[2]}) >= 0.05f &&
        std::max({color[0], color[1], color[2]}) <= 1) {
      inside.push_back(color);
    }
  }
  const std::vector<Rgba> there = convert(inside, "one", "linear", Backend::jit);
  const std::vector<Rgba> back = convert(there, "linear", "one", Backend::jit);
  ASSERT_EQ(back.size(), inside.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[i][k], inside[i][k], 1.0 / 4096);
  }
}

}  // namespace
}  // namespace nacre
