// `nacre render --crop`, read by OpenImageIO.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/render/image_layers.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

class CropOfTool : public Tool {
 protected:
  std::string asked(const std::string& more, const std::string& out) const {
    return "render " NACRE_SOURCE_DIR "/examples/documents/brass.mtlx --size 40x30 --spp 4 " +
           more + " --out " + file(out);
  }
};

TEST_F(CropOfTool, IsADataWindowInTheDisplayWindow) {
  const std::string layers = "--aov albedo,depth,crypto_object ";
  ASSERT_EQ(run(asked(layers, "whole.exr")), 0) << errors_;
  ASSERT_EQ(run(asked(layers + "--json --crop 11 7 31 24", "part.exr")), 0) << errors_;
  EXPECT_EQ(errors_, "");
  const auto answer = nlohmann::json::parse(printed_);
  EXPECT_EQ(answer["crop"], nlohmann::json({11, 7, 31, 24}));
  EXPECT_EQ(answer["paths"], 20 * 17 * 4);
  const Layers whole = layers_of(file("whole.exr")), part = layers_of(file("part.exr"));
  EXPECT_EQ(whole.window, whole.whole);
  EXPECT_EQ(part.whole, whole.whole);
  EXPECT_EQ(part.window, OIIO::ROI(11, 31, 7, 24, 0, 1, 0, int(part.planes.size())));
  ASSERT_EQ(part.planes.size(), whole.planes.size());
  EXPECT_EQ(part.texts, whole.texts);
  for (const auto& [name, plane] : part.planes) {
    ASSERT_EQ(plane.size(), 20u * 17) << name;
    for (std::size_t y = 0; y < 17; ++y) {
      for (std::size_t x = 0; x < 20; ++x) {
        ASSERT_EQ(plane[y * 20 + x], whole[name][(y + 7) * 40 + x + 11]) << name;
      }
    }
  }
  // It is one of another program's images as well.
  ASSERT_EQ(shell("oiiotool " + file("whole.exr") + " --crop 20x17+11+7 -o " + file("cut.exr") +
                  " && oiiotool --fail 0 --diff " + file("cut.exr") + " " + file("part.exr")),
            0)
      << printed_ << errors_;
}

TEST_F(CropOfTool, IsAllOfAPng) {
  ASSERT_EQ(run(asked("", "whole.png")), 0) << errors_;
  ASSERT_EQ(run(asked("--crop 11 7 31 24", "part.png")), 0) << errors_;
  EXPECT_TRUE(says("[crop-alone]") && says("20 by 17 pixels")) << errors_;
  const Layers whole = layers_of(file("whole.png")), part = layers_of(file("part.png"));
  EXPECT_EQ(part.window.width(), 20);
  EXPECT_EQ(part.window.height(), 17);
  for (std::size_t y = 0; y < 17; ++y) {
    for (std::size_t x = 0; x < 20; ++x) {
      ASSERT_EQ(part["G"][y * 20 + x], whole["G"][(y + 7) * 40 + x + 11]);
    }
  }
}

TEST_F(CropOfTool, OutsideOfThePictureIsAnError) {
  for (const char* crop : {"0 0 41 30", "-1 0 8 8", "8 0 8 8", "9 0 8 8", "0 8 8 31"}) {
    EXPECT_EQ(run(asked(std::string("--crop ") + crop, "a.exr")), 2) << crop;
    EXPECT_TRUE(says("[bad-crop]") && says("X1 <= 40") && says("Y1 <= 30")) << errors_;
  }
  EXPECT_EQ(run(asked("--crop 0 0 8", "a.exr")), 2);
  EXPECT_FALSE(std::filesystem::exists(file("a.exr")));
}

}  // namespace
}  // namespace nacre
