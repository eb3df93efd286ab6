#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/lambert_text.h"
#include "tests/support/run_kernel.h"
#include "tests/support/temporary_folder.h"

namespace nacre {

/// Materials of lobes by text, in a folder with their text.
class TextLobes : public ::testing::Test {
 protected:
  static constexpr const char* ports =
      R"(<input name="weight" type="float" value="1"/>
         <input name="color" type="color3" value="0.5, 0.25, 0.75"/>
         <input name="normal" type="vector3" defaultgeomprop="Nworld"/>)";

  TextLobes() {
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics_);
    options_.compile.backend = Backend::interpreter;
  }

  /// A nodedef of node `own`, implemented by own.glsl.
  static std::string nodedef(const std::string& inputs = ports, const std::string& attribute = "") {
    return "<nodedef name=\"ND_own\" node=\"own\" " + attribute + ">" + inputs +
           "<output name=\"out\" type=\"BSDF\"/></nodedef>\n"
           "<implementation name=\"IM_own\" nodedef=\"ND_own\" target=\"genglsl\" "
           "file=\"own.glsl\" function=\"own\"/>\n";
  }
  static std::string reads(const std::string& port, const std::string& type,
                           const std::string& node) {
    return "<input name=\"" + port + "\" type=\"" + type + "\" nodename=\"" + node + "\"/>";
  }

  std::unique_ptr<Document> read(const std::string& body) {
    return read_document_text("<materialx version=\"1.39\">\n" + body + "</materialx>",
                              folder_.file("test.mtlx"), {}, diagnostics_);
  }
  /// The material whose BSDF is node b; null after an error.
  std::unique_ptr<MaterialKernels> material(const std::string& body) {
    const auto document =
        read(body + "<surface name=\"s\" type=\"surfaceshader\">" + reads("bsdf", "BSDF", "b") +
             "</surface><surfacematerial name=\"M\" type=\"material\">" +
             reads("surfaceshader", "surfaceshader", "s") + "</surfacematerial>");
    if (document == nullptr || system_ == nullptr) return nullptr;
    return system_->compile_material(*document, "M", options_, diagnostics_);
  }

  /// What all kernels give at those points, in a frame whose normal is z; "next." what `sample`
  /// gives.
  static Columns everything(const MaterialKernels& kernels, Columns points) {
    for (const char* one : {"N.z", "Ng.z", "T.x", "B.y"}) points.emplace(one, std::vector{1.0f});
    if (kernels.begin) points.merge(run(kernels.begin->kernel(), points));
    Columns all = run(kernels.evaluate->kernel(), points);
    for (auto& [name, column] : run(kernels.sample->kernel(), points)) all["next." + name] = column;
    all.merge(run(kernels.albedo->kernel(), points));
    return all;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
  ShaderOptions options_;
};

}  // namespace nacre
