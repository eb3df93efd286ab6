#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "examples/image_input/image_name.h"
#include "examples/image_input/read_request.h"
#include "examples/image_input/wrong.h"
#include "tests/support/temporary_folder.h"

namespace graph_image {
namespace {

std::string fault_of(const std::string& name, const OIIO::ImageSpec* config = nullptr) {
  try {
    read_request(name, config);
  } catch (const Wrong& wrong) {
    return wrong.what();
  }
  return {};
}

TEST(GraphImageName, SplitsAtTheMarkAndAtTheSigns) {
  const ImageName name = split_name("a b/marble.mtlx?output=NG/x=y&size=4096");
  EXPECT_EQ(name.file, "a b/marble.mtlx");
  EXPECT_EQ(name.values,
            (std::map<std::string, std::string>{{"output", "NG/x=y"}, {"size", "4096"}}));
  EXPECT_EQ(split_name("x.mtlx").values.size(), 0u);
  EXPECT_EQ(split_name("x.mtlx?").values.size(), 0u);
  EXPECT_EQ(split_name("x.mtlx?a=").values.at("a"), "");
}

TEST(GraphImageName, OnlyOursAreTaken) {
  for (const char* file : {"x.mtlx", "a/X.MTLX", "x.mtlxtex"}) EXPECT_TRUE(is_graph_image(file));
  for (const char* file : {"x.exr", "mtlx", "x.mtlx/y", "", ".mtlx"}) {
    EXPECT_FALSE(is_graph_image(file)) << file;
  }
}

TEST(GraphImageRequest, SaysAllThatIsWanted) {
  const Request request = read_request(
      "x.mtlx?output=NG/c&size=300x20&frame=7.5&time=-2&samples=4&anisotropy=2&accuracy=fast"
      "&format=half&udim=1013&wrap=mirror&profile=p.json",
      nullptr);
  EXPECT_EQ(request.document, "x.mtlx");
  EXPECT_EQ(request.output, "NG/c");
  EXPECT_EQ(request.profile, "p.json");
  EXPECT_EQ(request.accuracy, Accuracy::fast);
  EXPECT_EQ(request.anisotropy, 2);
  EXPECT_EQ(request.frame, 7.5f);
  EXPECT_EQ(request.time, -2.0f);
  EXPECT_EQ(request.width, 300);
  EXPECT_EQ(request.height, 20);
  EXPECT_EQ(request.corner_u, 2);
  EXPECT_EQ(request.corner_v, 1);
  EXPECT_EQ(request.samples, 4);
  EXPECT_EQ(request.wrap, "mirror");
  EXPECT_TRUE(request.is_half);
}

TEST(GraphImageRequest, LeavesTheRestAsUsual) {
  const Request request = read_request("x.mtlx", nullptr);
  EXPECT_EQ(request.accuracy, Accuracy::standard);
  EXPECT_EQ(request.frame, 1.0f);
  EXPECT_EQ(request.width, 0);
  EXPECT_EQ(request.wrap, "periodic");
  EXPECT_FALSE(request.is_half);
  EXPECT_EQ(read_request("x.mtlx?udim=1001", nullptr).wrap, "clamp");
  EXPECT_EQ(read_request("x.mtlx?size=64", nullptr).height, 64);
}

TEST(GraphImageRequest, TheNameCountsBeforeTheConfiguration) {
  OIIO::ImageSpec config;
  config.attribute("mtlx:size", 512);
  config.attribute("mtlx:output", "G/a");
  config.attribute("mtlx:time", 0.5f);
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("nowait", 1);
  const Request request = read_request("x.mtlx?output=G/b", &config);
  EXPECT_EQ(request.width, 512);
  EXPECT_EQ(request.output, "G/b");
  EXPECT_EQ(request.time, 0.5f);
  config.attribute("mtlx:sise", 512);
  EXPECT_EQ(fault_of("x.mtlx", &config),
            "x.mtlx: error: nothing of an image is called so; expected accuracy, anisotropy, "
            "format, frame, output, profile, samples, size, time, udim, wrap, found 'sise' "
            "[bad-query]");
}

TEST(GraphImageRequest, ValuesThatMakeNoSenseAreRefused) {
  for (const char* query :
       {"size=0",         "size=",      "size=65537",   "size=12x",
        "size=x12",       "size=1x2x3", "size= 12",     "size=99999999999999999999",
        "frame=",         "frame=1e30", "frame=nan",    "time=inf",
        "time=2s",        "samples=0",  "samples=65",   "anisotropy=65",
        "accuracy=exact", "accuracy=",  "format=uint8", "udim=1000",
        "udim=10000",     "wrap=on",    "output=",      "profile="}) {
    const std::string fault = fault_of(std::string("x.mtlx?") + query);
    EXPECT_NE(fault.find(" cannot be that; expected "), std::string::npos) << query << fault;
    EXPECT_NE(fault.find("[bad-query]"), std::string::npos) << query << fault;
  }
  EXPECT_EQ(fault_of("x.mtlx?size=0"),
            "x.mtlx: error: 'size' cannot be that; expected N or WxH with 1 to 65536 texels, found "
            "'0' [bad-query]");
  EXPECT_EQ(fault_of("x.mtlx?size"),
            "x.mtlx: error: a part of the name behind '?' is not understood; expected key=value, "
            "found 'size' [bad-query]");
  EXPECT_EQ(fault_of("x.mtlx?size=1&size=2"),
            "x.mtlx: error: 'size' is asked for twice [bad-query]");
}

TEST(GraphImageRequest, AnyTextIsReadOrRefused) {
  const std::vector<std::string> parts{"x.mtlx", "?", "&",   "=",       "size",    "64",   "x",
                                       "-",      "0", "1e9", "output",  "udim",    "1001", "frame",
                                       "nan",    "/", "\n",  "%",       "samples", "wrap", "clamp",
                                       "{}",     "",  "é",   "profile", "\\"};
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string name = "x.mtlx?";
    for (std::size_t count = random() % 12; count > 0; --count) {
      name += parts[random() % parts.size()];
    }
    try {
      const Request request = read_request(name, nullptr);
      EXPECT_EQ(request.document, "x.mtlx") << name;
      EXPECT_TRUE(request.width >= 0 && request.width <= 65536) << name;
      EXPECT_TRUE(request.samples >= 1 && request.samples <= 64) << name;
    } catch (const Wrong&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10000);
  EXPECT_LT(refused, 20000);
}

TEST(GraphImageTextFile, StandsForTheNameInIt) {
  const nacre::TemporaryFolder folder;
  const std::string file =
      folder.write("wood.mtlxtex", "# What it is of.\n\n \twood.mtlx?output=G/c&size=64 \r\n");
  const Request request = read_request(file, nullptr);
  EXPECT_EQ(request.document, folder.file("wood.mtlx"));
  EXPECT_EQ(request.output, "G/c");
  EXPECT_EQ(request.width, 64);
  EXPECT_EQ(read_request(file + "?size=32", nullptr).width, 32);
  EXPECT_EQ(read_request(file + "?size=32", nullptr).output, "G/c");
}

TEST(GraphImageTextFile, SaysWhatIsWrongWithIt) {
  const nacre::TemporaryFolder folder;
  const auto fault = [&](std::string_view text) {
    return fault_of(folder.write("x.mtlxtex", text)).substr(folder.file("x.mtlxtex").size());
  };
  EXPECT_EQ(fault("a.mtlx\nb.mtlx\n"),
            ": error: the file has several lines; expected one, found 'b.mtlx' [bad-texture-file]");
  const std::string no_document =
      ": error: the file names no document; expected a line as "
      "'marble.mtlx?output=NG_marble/base_color&size=4096', found ";
  EXPECT_EQ(fault(""), no_document + "'' [bad-texture-file]");
  EXPECT_EQ(fault("x.mtlxtex"), no_document + "'x.mtlxtex' [bad-texture-file]");
  EXPECT_EQ(fault(std::string(70000, 'x')),
            ": error: the file is too long; expected at most 65536 bytes [bad-texture-file]");
  EXPECT_EQ(fault_of(folder.file("none.mtlxtex")),
            folder.file("none.mtlxtex") + ": error: the file cannot be read [cannot-read]");
  EXPECT_EQ(fault_of(folder.path().string() + "/.mtlxtex?a=1"),
            folder.path().string() +
                "/.mtlxtex: error: nothing of an image is called so; expected "
                "accuracy, anisotropy, format, frame, output, profile, samples, size, time, udim, "
                "wrap, found 'a' [bad-query]");
}

}  // namespace
}  // namespace graph_image
