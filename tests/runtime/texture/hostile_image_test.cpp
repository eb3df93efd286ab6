// Files that would cost too much, or reach code that nothing needs: refused by what they
// are, before it happens.
#include "tests/runtime/texture/hostile_image.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "runtime/texture/image_io.h"
#include "runtime/texture/texture_store.h"
#include "tests/runtime/texture/bytes_as_image.h"

namespace nacre {
namespace {

class HostileImage : public BytesAsImage {};

TEST_F(HostileImage, OnlyTheFormatsOfTexturesAreRead) {
  // A volume in DDS, a GIF of no version, Photoshop, two letters, WebP, FITS, DPX, SGI, PPM.
  const std::string zeros(64, '\0');
  for (const std::string start :
       {"DDS |", "GIF90a\xff\xff\xff\xff", "8BPS", "BM", "RIFF\1\1\1\1WEBPVP8 ",
        "SIMPLE  =", "SDPX", "\x01\xda", "P6\n1 1\n255\nabc", "<svg", "#?RAD"}) {
    EXPECT_EQ(code_of(start + zeros), "unsupported-image") << start;
  }
}

TEST_F(HostileImage, PipesAndFoldersAreNotWaitedFor) {
  ASSERT_EQ(::mkfifo(file("pipe.png").c_str(), 0600), 0);
  ImageReader reader;
  for (const std::string& path :
       {file("pipe.png"), folder_.path().string(), std::string("/dev/zero")}) {
    const auto problem = reader.open(path, "", {});
    ASSERT_TRUE(problem.has_value());
    EXPECT_EQ(problem->code, "unreadable-image");
  }
}

TEST_F(HostileImage, TgaIsToldByItsHeaderWhateverItsName) {
  const std::string pixels(4 * 4 * 3, '\x40');
  EXPECT_EQ(code_of(tga_header(4, 4) + pixels), "");
  EXPECT_EQ(code_of(tga_header(4, 4, 3, 8) + pixels), "");
  EXPECT_EQ(code_of(tga_header(4, 4) + pixels.substr(1)), "broken-image");
  EXPECT_EQ(code_of(tga_header(4, 4, 10) + std::string("\x8f\1\2\3", 4)), "");
  EXPECT_EQ(code_of(tga_header(4, 4, 10) + std::string("\x8e\1\2\3", 4)), "broken-image");
  EXPECT_EQ(code_of(tga_header(4, 4, 1, 8) + pixels), "unsupported-image");  // A palette.
  // The areas of version 2.0 are not looked at: their place is behind the end.
  const std::string mark("TRUEVISION-XFILE.\0", 18);
  EXPECT_EQ(code_of(tga_header(4, 4) + pixels + std::string(8, '\x7f') + mark), "");
  const std::string all_mark = pixels.substr(0, pixels.size() - mark.size()) + mark;
  EXPECT_EQ(code_of(tga_header(4, 4) + all_mark), "");
}

TEST_F(HostileImage, VolumesAndTooManyChannelsAreRefused) {
  EXPECT_EQ(code_of(tiff(16, 16)), "") << found_;
  // ImageDepth, with tiles of as many layers.
  const std::vector<TiffEntry> volume{{.tag = 32997, .value = 64}};
  EXPECT_EQ(code_of(tiff(16, 16, volume)), "broken-image") << found_;
  EXPECT_NE(found_.find("volume"), std::string::npos) << found_;
  const std::vector<TiffEntry> channels{{.tag = 277, .value = 2000}};
  EXPECT_NE(code_of(tiff(4, 4, channels)), "") << found_;
  WriteOptions options;
  options.type = "half";
  ASSERT_TRUE(write_image(file("many.exr"), random_image(2, 2, 70, 255), options));
  ImageLimits limits;
  EXPECT_EQ(code_of(read_file(file("many.exr")), limits), "") << found_;
  limits.max_channels = 69;
  EXPECT_EQ(code_of(read_file(file("many.exr")), limits), "broken-image") << found_;
  ASSERT_TRUE(write_image(file("many.tif"), random_image(2, 2, 70, 255)));
  EXPECT_EQ(code_of(read_file(file("many.tif")), limits), "image-too-large") << found_;
}

TEST_F(HostileImage, ThePictureThatPixelsArePartOfIsHeldAgainstTheLimitsToo) {
  WriteOptions options;
  options.type = "half";
  options.full_width = options.full_height = 16383;
  ASSERT_TRUE(write_image(file("a.exr"), random_image(64, 64, 1, 255), options));
  EXPECT_EQ(code_of(read_file(file("a.exr"))), "image-too-large");
  options.full_width = 20000;
  options.full_height = 10;
  ASSERT_TRUE(write_image(file("b.exr"), random_image(4, 4, 1, 255), options));
  EXPECT_EQ(code_of(read_file(file("b.exr"))), "image-too-large") << found_;
  // A crop of a picture of usual size is what it says.
  options.full_width = options.full_height = 2000;
  ASSERT_TRUE(write_image(file("c.exr"), random_image(64, 64, 1, 255), options));
  EXPECT_EQ(code_of(read_file(file("c.exr"))), "") << found_;
}

TEST_F(HostileImage, ManyBytesFromFewAreRefusedBeforeTheyAreUnpacked) {
  EXPECT_EQ(code_of(png_of_noise(16000, 16000, 250'000)), "image-too-large") << found_;
  // Not as large, it gets as far as being unpacked.
  EXPECT_EQ(code_of(png_of_noise(4000, 4000, 250'000)), "broken-image") << found_;
  ImageLimits limits;
  limits.max_expansion = 2000;
  EXPECT_EQ(code_of(png_of_noise(16000, 16000, 250'000), limits), "broken-image") << found_;
  // More data than such an image can need is not even read.
  EXPECT_EQ(code_of(png_of_noise(1, 1, 3 << 20)), "broken-image");
  EXPECT_NE(found_.find("more data than the pixels need"), std::string::npos) << found_;
}

TEST_F(HostileImage, JpegOfManyScansOrFramesOrCutShort) {
  ASSERT_TRUE(write_image(file("a.jpg"), random_image(32, 32, 1, 255)));
  const std::string whole = read_file(file("a.jpg"));
  EXPECT_EQ(code_of(whole), "");
  const std::size_t scan = whole.find("\xff\xda"), frame = whole.find("\xff\xc0");
  ASSERT_NE(scan, std::string::npos);
  ASSERT_NE(frame, std::string::npos);
  const std::string data = whole.substr(scan, whole.size() - 2 - scan),
                    end = whole.substr(whole.size() - 2);
  std::string many = whole.substr(0, scan);
  for (int i = 0; i < 101; ++i) many += data;
  EXPECT_EQ(code_of(many + end), "broken-image");
  EXPECT_NE(found_.find("too many scans"), std::string::npos) << found_;
  std::string large = whole;  // A second frame, after the first was looked at.
  std::string second = whole.substr(frame, 19 - 6);
  second[5] = second[7] = '\x7f';
  large.insert(scan, second);
  EXPECT_EQ(code_of(large), "broken-image") << found_;
  large = whole;
  large[frame + 5] = large[frame + 7] = '\x7f';
  EXPECT_EQ(code_of(large), "image-too-large") << found_;
  for (std::size_t size = 2; size < whole.size(); size += 1 + whole.size() / 60) {
    EXPECT_NE(code_of(whole.substr(0, size)), "") << size;
  }
  // Application data may say what they want.
  std::string odd = whole;
  odd.insert(2, std::string("\xff\xed\0\x14Photoshop 3.0\0\xff\xff\xff", 22));
  EXPECT_EQ(code_of(odd), "") << found_;
}

TEST_F(HostileImage, TiffDirectoriesThatLieOrGoRound) {
  EXPECT_EQ(code_of(tiff(4, 4, {}, 8 + 16)), "broken-image");
  EXPECT_NE(found_.find("circle"), std::string::npos) << found_;
  EXPECT_EQ(code_of(tiff(4, 4, {}, 0x7fffffff)), "broken-image");
  EXPECT_EQ(code_of(tiff(4, 4, {{.tag = 273, .count = 0x10000000}})), "broken-image");
  EXPECT_EQ(code_of(tiff(32768, 32768)), "image-too-large") << found_;
  EXPECT_EQ(code_of(tiff(4, 4, {{.tag = 259, .value = 6}})), "unsupported-image") << found_;
}

/// The reader would go down the elements one call each.
TEST_F(HostileImage, DescriptionsInLanguagesOfTheirOwnAreNotRead) {
  std::string deep;
  for (int i = 0; i < 300'000; ++i) deep += "<a>";
  EXPECT_EQ(code_of(tiff(4, 4, {{.tag = 700, .type = 7, .text = deep}})), "") << found_;
  EXPECT_EQ(code_of(tiff(4, 4, {{.tag = 33723, .type = 7, .text = std::string(9, '\x1c')}})), "");
}

TEST_F(HostileImage, AStopEndsTheReading) {
  ASSERT_TRUE(write_image(file("a.tif"), random_image(64, 64, 3, 255)));
  const std::string bytes = read_file(file("a.tif"));
  EXPECT_EQ(code_of(bytes, {}, Stop().within(1000)), "");
  EXPECT_EQ(code_of(bytes, {}, Stop().within(0)), "stopped");
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(code_of(bytes, {}, Stop(source.get_token())), "stopped");
  TextureStore store;
  Diagnostics diagnostics;
  EXPECT_TRUE(store.acquire({file("a.tif"), "", {}}, diagnostics, Stop().within(0))->missing());
  EXPECT_TRUE(store.acquire({file("a.tif"), "", {}}, diagnostics)->resident());
}

}  // namespace
}  // namespace nacre
