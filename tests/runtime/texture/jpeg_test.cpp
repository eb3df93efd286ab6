// JPEGs, which libjpeg reads for us, beside what OpenImageIO's reader makes of them.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <map>

#include "runtime/texture/image_io.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

class Jpeg : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.path() / name; }

  /// By OpenImageIO alone; `scans` and `sampling` as it calls them.
  void write(const std::string& name, const TestImage& image, const std::string& sampling,
             bool is_progressive) const {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec.attribute("jpeg:subsampling", sampling);
    spec.attribute("jpeg:progressive", is_progressive ? 1 : 0);
    spec.attribute("compression", "jpeg:83");
    const auto out = OIIO::ImageOutput::create(file(name));
    ASSERT_TRUE(out && out->open(file(name), spec));
    ASSERT_TRUE(out->write_image(OIIO::TypeFloat, image.samples.data()));
    ASSERT_TRUE(out->close());
  }

  std::vector<float> by_openimageio(const std::string& name) const {
    const auto in = OIIO::ImageInput::open(file(name));
    const OIIO::ImageSpec& spec = in->spec();
    std::vector<float> samples(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    EXPECT_TRUE(in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, samples.data()));
    return samples;
  }

  /// The problem, if any; samples in `samples_`.
  std::string read(const std::string& name, const std::string& layer = "") {
    samples_.clear();
    auto problem = reader_.open(file(name), layer, {});
    if (problem) return problem->code;
    const auto count = static_cast<std::size_t>(reader_.info().width) *
                       static_cast<std::size_t>(reader_.info().channels);
    problem = reader_.read(
        [&](int, const float* row) { samples_.insert(samples_.end(), row, row + count); });
    if (problem) found_ = problem->found;
    return problem ? problem->code : "";
  }

  TemporaryFolder folder_;
  ImageReader reader_;
  std::vector<float> samples_;
  std::string found_;
};

TEST_F(Jpeg, HasTheBitsOfOpenImageIo) {
  for (const int channels : {1, 3}) {
    for (const std::string sampling : {"4:4:4", "4:2:2", "4:2:0"}) {
      for (const bool is_progressive : {false, true}) {
        for (const auto& [width, height] : {std::pair{64, 48}, {37, 129}, {1, 1}}) {
          write("a.jpg", random_image(width, height, channels, 255), sampling, is_progressive);
          ASSERT_EQ(read("a.jpg"), "");
          EXPECT_EQ(reader_.info().width, width);
          EXPECT_EQ(reader_.info().height, height);
          EXPECT_EQ(reader_.info().channels, channels);
          EXPECT_EQ(reader_.info().samples, SampleType::unsigned8);
          ASSERT_EQ(samples_, by_openimageio("a.jpg"))
              << channels << ' ' << sampling << ' ' << width;
          ASSERT_EQ(read("a.jpg", "0"), "");  // Whose layer it is asked for, reads the same.
          ASSERT_EQ(samples_, by_openimageio("a.jpg"));
        }
      }
    }
  }
}

// What libjpeg fills in is not what the file has.
TEST_F(Jpeg, WhatIsMadeUpIsBroken) {
  write("a.jpg", random_image(64, 64, 3, 255), "4:4:4", false);
  const std::string whole = read_file(file("a.jpg"));
  const std::size_t middle = whole.size() / 2;
  write_file(file("b.jpg"), whole.substr(0, middle) + whole.substr(whole.size() - 2));
  EXPECT_EQ(read("b.jpg"), "broken-image");
  EXPECT_NE(found_.find("JPEG error: "), std::string::npos) << found_;
}

// Four components, inks, are OpenImageIO's to read: as it reads them, or not at all.
TEST_F(Jpeg, OtherColoursAreLeftToOpenImageIo) {
  write("a.jpg", random_image(16, 16, 1, 255), "4:4:4", false);
  const std::string grey = read_file(file("a.jpg"));
  const std::size_t frame = grey.find("\xff\xc0"), scan = grey.find("\xff\xda");
  ASSERT_NE(frame, std::string::npos);
  ASSERT_NE(scan, std::string::npos);
  // The one component four times, each in a scan of its own (ITU-T T.81, B.2.2 and B.2.3).
  std::string head("\xff\xc0\0\x14\x08\0\x10\0\x10\x04", 10);
  for (char i = 1; i <= 4; ++i) head += std::string{i, '\x11', '\0'};
  const std::string data = grey.substr(scan + 10, grey.size() - 2 - scan - 10);
  std::string inks = grey.substr(0, frame) + head + grey.substr(frame + 13, scan - frame - 13);
  for (char i = 1; i <= 4; ++i) {
    inks += std::string("\xff\xda\0\x08\x01", 5) + i + std::string("\0\0\x3f\0", 4) + data;
  }
  write_file(file("b.jpg"), inks + "\xff\xd9");
  ASSERT_EQ(read("b.jpg"), "");
  EXPECT_EQ(samples_, by_openimageio("b.jpg"));
}

}  // namespace
}  // namespace nacre
