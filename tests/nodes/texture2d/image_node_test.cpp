#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/nodes.h"
#include "tests/nodes/texture2d/lookups.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

/// `image` with literal inputs, texcoord from the point.
class ImageNodeTest : public testing::Test {
 protected:
  /// What the node gives; -1 where it has no component.
  Float4 look_up(Recorder& recorder, TextureProvider& textures, Float2 uv, Type type,
                 const std::string& path, const std::string& filter = "linear",
                 const std::string& mode = "periodic") {
    const auto text = [](Type t, const std::string& value) {
      Recorded recorded;
      recorded.type = t;
      recorded.text = value;
      return recorded;
    };
    Recorded fallback;
    fallback.type = type;
    for (int i = 0; i < component_count(type); ++i) fallback.parts.push_back(Float(0.25f).ref());
    std::vector<NodeCall::Port> inputs{{"file", text(Type::filename, path)},
                                       {"layer", text(Type::string, "")},
                                       {"default", fallback},
                                       {"texcoord", Recorded(Type::vector2, uv)},
                                       {"uaddressmode", text(Type::string, mode)},
                                       {"vaddressmode", text(Type::string, mode)},
                                       {"filtertype", text(Type::string, filter)}};
    Recorded out;
    out.type = type;
    NodeCall call(recorder, "image", "ND_image", std::move(inputs), {{"out", out}},
                  Accuracy::standard, &textures, diagnostics_, {});
    body("image").record(call);
    const auto& parts = call.outputs().front().value.parts;
    const auto part = [&](std::size_t i) { return i < parts.size() ? Float(parts[i]) : -1.0f; };
    return Float4{part(0), part(1), part(2), part(3)};
  }

  RecordedLookup record(Type type, const std::string& path, const std::string& filter = "linear",
                        const std::string& mode = "periodic") {
    return RecordedLookup(store_, [&](Recorder& recorder, TextureProvider& textures, Float2 uv) {
      return look_up(recorder, textures, uv, type, path, filter, mode);
    });
  }

  static const NodeBody& body(std::string_view category) {
    const auto& all = standard_nodes();
    return *std::ranges::find_if(all, [&](const NodeBody& b) { return b.category == category; });
  }

  std::string write(const char* name, int channels) {
    const std::string path = folder_.file(name);
    TestImage image{2, 2, channels, {}};
    for (int i = 0; i < 4 * channels; ++i) {
      image.samples.push_back(static_cast<float>(i % channels + 1) / 5.0f);
    }
    EXPECT_TRUE(write_image(path, image));
    return path;
  }

  /// No channel is the same everywhere.
  std::string write_noise(const char* name, int channels) {
    const std::string path = folder_.file(name);
    EXPECT_TRUE(write_image(path, random_image(2, 2, channels, 255)));
    return path;
  }
  /// Alpha is.
  std::string write_opaque(const char* name, float alpha) {
    const std::string path = folder_.file(name);
    TestImage image = random_image(2, 2, 4, 255);
    for (std::size_t i = 3; i < image.samples.size(); i += 4) image.samples[i] = alpha;
    EXPECT_TRUE(write_image(path, image));
    return path;
  }

  TemporaryFolder folder_;
  TextureStore store_;
  Diagnostics diagnostics_;
};

// MaterialX 1.39 Standard Nodes, image: missing channels are zero, alpha one.
TEST_F(ImageNodeTest, ChannelsTheFileLacks) {
  LookupPoints points;
  points.add(0.5f, 0.5f);
  const auto value = [&](Type type, int channels) {
    return record(type, write((std::to_string(channels) + ".png").c_str(), channels))
        .run(points)
        .front();
  };
  using Rgba = std::array<float, 4>;
  const auto expect = [](const Rgba& a, const Rgba& b) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(a[c], b[c], 1e-6);
  };
  expect(value(Type::color3, 1), {0.2f, 0, 0, -1});
  expect(value(Type::color4, 1), {0.2f, 0, 0, 1});
  expect(value(Type::vector4, 2), {0.2f, 0.4f, 0, 1});
  expect(value(Type::color4, 3), {0.2f, 0.4f, 0.6f, 1});
  expect(value(Type::color4, 4), {0.2f, 0.4f, 0.6f, 0.8f});
  expect(value(Type::float_, 4), {0.2f, -1, -1, -1});
  expect(value(Type::vector2, 4), {0.2f, 0.4f, -1, -1});
}

TEST_F(ImageNodeTest, NoFileIsTheDefaultWithoutComplaint) {
  LookupPoints points;
  points.add(0.5f, 0.5f);
  const RecordedLookup lookup = record(Type::vector2, "");
  EXPECT_EQ(lookup.run(points).front(), (std::array<float, 4>{0.25f, 0.25f, -1, -1}));
  EXPECT_TRUE(lookup.diagnostics().all().empty());
}

TEST_F(ImageNodeTest, UnknownModeIsReportedAndPeriodic) {
  const std::string path = write("a.png", 3);
  const auto odd = record(Type::color3, path, "linear", "wrap").run(random_points(20, 2, 2, 1));
  EXPECT_EQ(diagnostics_.warning_count(), 2u);
  EXPECT_EQ(odd, record(Type::color3, path).run(random_points(20, 2, 2, 1)));
}

/// The code of a look-up is as large as a small shader.
TEST_F(ImageNodeTest, ImagesOfOneKindShareTheCodeThatFiltersThem) {
  const auto functions = [&](const std::vector<std::pair<std::string, std::string>>& images) {
    const RecordedLookup all(store_, [&](Recorder& recorder, TextureProvider& textures, Float2 uv) {
      Float4 sum{0.0f, 0.0f, 0.0f, 0.0f};
      for (const auto& [path, mode] : images) {
        const Float4 one = look_up(recorder, textures, uv, Type::color4, path, "linear", mode);
        sum = {sum.x + one.x, sum.y + one.y, sum.z + one.z, sum.w + one.w};
      }
      return sum;
    });
    return all.program().functions.size() - 1;
  };
  std::vector<std::pair<std::string, std::string>> images;
  for (const char* name : {"a.png", "b.png", "c.png", "d.png", "e.png"}) {
    images.emplace_back(write_noise(name, 4), "periodic");
  }
  EXPECT_EQ(functions(images), 1u);
  // Other borders, and other channels, are filtered by other code.
  images.emplace_back(write_noise("f.png", 4), "mirror");
  EXPECT_EQ(functions(images), 2u);
  images.emplace_back(write_noise("g.png", 3), "mirror");
  EXPECT_EQ(functions(images), 3u);
  // So are such as have no alpha to look up, whatever it is.
  images.emplace_back(write_opaque("h.png", 1), "mirror");
  EXPECT_EQ(functions(images), 4u);
  images.emplace_back(write_opaque("i.png", 0.5f), "mirror");
  EXPECT_EQ(functions(images), 4u);
}

}  // namespace
}  // namespace nacre
