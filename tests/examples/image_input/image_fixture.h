#pragma once

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace graph_image {

/// A document of one graph G, in which `nodes` compute; `outputs` may name them.
inline std::string document_of(std::string_view nodes) {
  return "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n<nodegraph name=\"G\">\n" +
         std::string(nodes) + "\n</nodegraph>\n</materialx>\n";
}

/// Texture coordinates themselves.
inline std::string ramp() {
  return document_of(R"(<texcoord name="uv" type="vector2" />
<output name="out" type="vector2" nodename="uv" />)");
}

/// The same grey everywhere.
inline std::string grey(std::string_view value) {
  return document_of(
      "<constant name=\"c\" type=\"float\"><input name=\"value\" type=\"float\" value=\"" +
      std::string(value) +
      "\" /></constant>\n<output name=\"out\" type=\"float\" nodename=\"c\" />");
}

/// Images by the plug-in itself, as any program opens them.
class GraphImages : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { OIIO::attribute("plugin_searchpath", NACRE_PLUGIN_FOLDER); }

  /// Null after a failed assertion.
  std::unique_ptr<OIIO::ImageInput> open(const std::string& name) {
    auto image = OIIO::ImageInput::open(name);
    EXPECT_NE(image, nullptr) << OIIO::geterror();
    return image;
  }
  /// What is said of a name that cannot be opened.
  std::string complaint(const std::string& name) {
    const auto image = OIIO::ImageInput::open(name);
    EXPECT_EQ(image, nullptr) << name;
    return OIIO::geterror();
  }
  /// Every sample of a level; none after an error.
  std::vector<float> read(OIIO::ImageInput& image, int level = 0) {
    const OIIO::ImageSpec spec = image.spec_dimensions(0, level);
    std::vector<float> texels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    const bool done =
        image.read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texels.data());
    EXPECT_TRUE(done) << image.geterror();
    if (!done) texels.clear();
    return texels;
  }
  std::vector<float> read(const std::string& name) {
    const auto image = open(name);
    return image != nullptr ? read(*image) : std::vector<float>();
  }
  std::string write(std::string_view name, std::string_view text) const {
    return folder_.write(name, text);
  }

  nacre::TemporaryFolder folder_;
  const std::string marble_ = NACRE_SOURCE_DIR "/examples/documents/marble.mtlx";
};

}  // namespace graph_image
