#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {

using Numbers = std::map<std::string, float>;
using Colour = std::array<float, 3>;

/// Nodes of pbs/library at one point, in the interpreter at `precise`.
class OwnLibrary : public ::testing::Test {
 protected:
  OwnLibrary() {
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics_);
    options_.compile.backend = Backend::interpreter;
    options_.compile.accuracy = Accuracy::precise;
  }

  std::unique_ptr<Document> read(const std::string& nodes) {
    return read_document_text("<materialx version=\"1.39\">" + nodes + "</materialx>", "test.mtlx",
                              {}, diagnostics_);
  }

  /// One point in a frame whose normal is z, seen from (sin, 0, cos); by name without its node's.
  static Numbers run(const BoundKernel& kernel, const Numbers& point) {
    const Program& program = kernel.program();
    const Numbers frame{{"N.z", 1.0f}, {"Ng.z", 1.0f}, {"T.x", 1.0f}, {"B.y", 1.0f}};
    std::vector<float> values;
    for (const Channel& channel : program.inputs) {
      const auto given = point.find(channel.name);
      const auto usual = frame.find(channel.name);
      values.push_back(given != point.end()   ? given->second
                       : usual != frame.end() ? usual->second
                                              : 0.0f);
    }
    std::vector<const void*> in;
    for (const float& value : values) in.push_back(&value);
    std::vector<float> results(program.outputs.size());
    std::vector<void*> out;
    for (float& result : results) out.push_back(&result);
    EXPECT_EQ(kernel.run(in, out, 1), RunStatus::done);
    Numbers numbers;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::string& name = program.outputs[i].name;
      numbers[name.starts_with("n.") ? name.substr(2) : name] = results[i];
    }
    return numbers;
  }

  /// The channels of node or output n.
  Numbers value(const std::string& nodes, const Numbers& point = {}) {
    const auto document = read(nodes);
    if (document == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), Numbers();
    const auto kernel = system_->compile_outputs(*document, {"n"}, options_, diagnostics_);
    if (kernel == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), Numbers();
    return run(kernel->kernel, point);
  }

  std::unique_ptr<MaterialKernels> material(const std::string& nodes) {
    const auto document = read(nodes + R"(
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)");
    if (document == nullptr) return nullptr;
    return system_->compile_material(*document, "M", options_, diagnostics_);
  }

  /// What the BSDF b sends back to a view at that cosine.
  Colour albedo(const std::string& nodes, float cosine = 1.0f) {
    const auto kernels = material(nodes);
    if (kernels == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), Colour();
    const Numbers all =
        run(*kernels->albedo,
            {{"wo.x", std::sqrt(1.0f - cosine * cosine)}, {"wo.y", 0.0f}, {"wo.z", cosine}});
    return {all.at("albedo.x"), all.at("albedo.y"), all.at("albedo.z")};
  }

  static void expect_colour(Colour a, Colour b, float tolerance) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "channel " << i;
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
  ShaderOptions options_;
};

/// Elements of a document.
/// @{
inline std::string value_of(const std::string& name, const std::string& type,
                            const std::string& value) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

inline std::string from(const std::string& name, const std::string& type, const std::string& node) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" nodename=\"" + node + "\"/>";
}

inline std::string node(const std::string& category, const std::string& type,
                        const std::string& name, const std::string& inputs) {
  return "<" + category + " name=\"" + name + "\" type=\"" + type + "\">" + inputs + "</" +
         category + ">";
}
/// @}

}  // namespace nacre
