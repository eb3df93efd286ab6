#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/temporary_folder.h"

namespace nacre {

/// Compiles the output "G/o" of graphs.
class Bake : public ::testing::Test {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics);
    ASSERT_NE(system_, nullptr) << diagnostics.to_string();
  }

  /// Of these nodes, one of them named n.
  std::unique_ptr<const OutputKernel> kernel_of(const std::string& nodes,
                                                const std::string& type = "float") {
    const std::string file =
        folder_.write("a.mtlx", "<materialx version=\"1.39\"><nodegraph name=\"G\">" + nodes +
                                    "<output name=\"o\" type=\"" + type +
                                    "\" nodename=\"n\"/></nodegraph></materialx>");
    Diagnostics diagnostics;
    const auto document = read_document(file, {}, diagnostics);
    auto kernel =
        document ? system_->compile_outputs(*document, {"G/o"}, {}, diagnostics) : nullptr;
    EXPECT_NE(kernel, nullptr) << diagnostics.to_string();
    EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.to_string();
    return kernel;
  }

  /// A node "image" of a square of grey bytes, from the top.
  std::string grey_image(int side, const std::vector<unsigned char>& bytes) {
    std::string tga(18, '\0');  // Without compression.
    tga[2] = 3;
    tga[12] = tga[14] = static_cast<char>(side % 256);
    tga[13] = tga[15] = static_cast<char>(side / 256);
    tga[16] = 8;
    tga[17] = 0x20;
    for (const unsigned char byte : bytes) tga += static_cast<char>(byte);
    return "<image name='image' type='float'><input name='file' type='filename' value='" +
           folder_.write("image.tga", tga) + "'/></image>";
  }

  TemporaryFolder folder_;
  std::unique_ptr<ShadingSystem> system_;
};

/// Squares of 0 and 1, `count` of them along uv's sides, turned by `degrees` around (0, 0).
inline std::string checker_nodes(const std::string& degrees, const std::string& count) {
  return "<texcoord name='t' type='vector2'/>"
         "<rotate2d name='r' type='vector2'><input name='in' type='vector2' nodename='t'/>"
         "<input name='amount' type='float' value='" +
         degrees +
         "'/></rotate2d>"
         "<multiply name='s' type='vector2'><input name='in1' type='vector2' nodename='r'/>"
         "<input name='in2' type='float' value='" +
         count +
         "'/></multiply>"
         "<floor name='f' type='vector2'><input name='in' type='vector2' nodename='s'/></floor>"
         "<dotproduct name='d' type='float'><input name='in1' type='vector2' nodename='f'/>"
         "<input name='in2' type='vector2' value='1, 1'/></dotproduct>"
         "<modulo name='n' type='float'><input name='in1' type='float' nodename='d'/>"
         "<input name='in2' type='float' value='2'/></modulo>";
}

}  // namespace nacre
