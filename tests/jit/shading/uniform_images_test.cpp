// Channels of images that are the same everywhere: known while kernels are made, said, and never
// taken for known where the image may be another one later.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

/// Occlusion, roughness and metalness of two texels, side by side: 8 bits, rgb.
using Texels = std::array<std::uint8_t, 6>;
constexpr Texels no_metal{255, 51, 0, 255, 153, 0};
constexpr Texels some_metal{255, 51, 0, 255, 153, 255};

/// A file of Truevision's TGA, which has blue first.
std::string tga(const Texels& rgb) {
  std::string file(18, '\0');
  file[2] = 2;
  file[12] = 2, file[14] = 1;
  file[16] = 24;
  for (const std::size_t texel : {std::size_t{0}, std::size_t{3}}) {
    for (const std::size_t c : {2u, 1u, 0u}) file += static_cast<char>(rgb[texel + c]);
  }
  return file;
}

std::string document(const std::string& image) {
  return R"(<materialx version="1.39">
    <image name="orm" type="color3">
      <input name="file" type="filename" value=")" +
         image + R"("/></image>
    <separate3 name="parts" type="multioutput"><input name="in" type="color3" nodename="orm"/></separate3>
    <standard_surface name="s" type="surfaceshader">
      <input name="specular_roughness" type="float" nodename="parts" output="outg"/>
      <input name="metalness" type="float" nodename="parts" output="outb"/></standard_surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial></materialx>)";
}

class UniformImages : public ::testing::Test {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
    options_.footprints = false;
    options_.compile.backend = Backend::interpreter;
  }

  std::unique_ptr<MaterialKernels> compile(const std::string& image) {
    const auto read = read_document_text(document(image), folder_.file("d.mtlx"), {}, diagnostics_);
    auto kernels = system_->compile_material(*read, "M", options_, diagnostics_);
    EXPECT_NE(kernels, nullptr) << diagnostics_.to_string();
    return kernels;
  }
  void set_image(const Texels& texels) {
    const Pixels pixels{.width = 2, .height = 1, .channels = 3, .data = texels.data()};
    ASSERT_TRUE(system_->textures().set_image("painted", pixels, diagnostics_));
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
  ShaderOptions options_;
};

bool has_lobe(const MaterialKernels& kernels, const std::string& name) {
  return std::ranges::count(kernels.lobes, name, &LobeInfo::name) > 0;
}
bool says(const MaterialKernels& kernels, const std::string& part) {
  return std::ranges::any_of(kernels.manifest, [&](const std::string& line) {
    return line.find(part) != std::string::npos;
  });
}

/// The albedo seen from straight above, across both texels.
std::vector<float> albedos(const MaterialKernels& kernels) {
  constexpr std::size_t count = 64;
  std::vector<float> zeros(count, 0.0f), ones(count, 1.0f), u;
  for (std::size_t i = 0; i < count; ++i) u.push_back((static_cast<float>(i) + 0.5f) / count);
  std::vector<const void*> inputs;
  for (const Channel& channel : kernels.albedo->program().inputs) {
    const auto& name = channel.name;
    const bool is_up = name == "N.z" || name == "Ng.z" || name == "wo.z" || name == "T.x";
    inputs.push_back(name == "uv0.x" ? u.data() : is_up ? ones.data() : zeros.data());
  }
  std::vector<std::vector<float>> results(3, zeros);
  std::vector<void*> outputs;
  for (std::vector<float>& result : results) outputs.push_back(result.data());
  EXPECT_EQ(kernels.albedo->run(inputs, outputs, count), RunStatus::done);
  std::vector<float> all;
  for (const std::vector<float>& result : results)
    all.insert(all.end(), result.begin(), result.end());
  return all;
}

TEST_F(UniformImages, LeaveLobesOut) {
  folder_.write("none.tga", tga(no_metal));
  folder_.write("some.tga", tga(some_metal));
  const auto none = compile("none.tga"), some = compile("some.tga");
  EXPECT_TRUE(has_lobe(*some, "conductor_bsdf"));
  EXPECT_FALSE(has_lobe(*none, "conductor_bsdf"));
  EXPECT_TRUE(says(*none, "conductor_bsdf at s/metal_bsdf: weight 0"));
  EXPECT_TRUE(says(*none, "none.tga: r is 1, b is 0 everywhere"));
  EXPECT_TRUE(says(*some, "some.tga: r is 1 everywhere"));
}

// What the same pixels give where nobody may rely on them.
TEST_F(UniformImages, ChangeNoNumber) {
  for (const Texels& texels : {no_metal, some_metal}) {
    folder_.write("file.tga", tga(texels));
    system_->textures().drop_unused();
    set_image(texels);
    const auto known = compile("file.tga"), unknown = compile("painted");
    EXPECT_TRUE(has_lobe(*unknown, "conductor_bsdf"));
    const std::vector<float> expected = albedos(*unknown), found = albedos(*known);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(found[i], expected[i]) << i;
    }
  }
}

TEST_F(UniformImages, OfTheHostMayBeReplaced) {
  set_image(no_metal);
  const auto kernels = compile("painted");
  EXPECT_FALSE(says(*kernels, "everywhere"));
  const std::vector<float> before = albedos(*kernels);
  set_image(some_metal);
  EXPECT_NE(albedos(*kernels), before);
}

// Who holds a shader keeps the pixels of its file; the next one has the new ones.
TEST_F(UniformImages, OfFilesThatAreWrittenAgainAreThoseOfTheNextShader) {
  folder_.write("file.tga", tga(no_metal));
  const auto first = compile("file.tga");
  folder_.write("file.tga", tga(some_metal) + ' ');
  const auto second = compile("file.tga");
  EXPECT_FALSE(has_lobe(*first, "conductor_bsdf"));
  EXPECT_TRUE(has_lobe(*second, "conductor_bsdf"));
}

}  // namespace
}  // namespace nacre
