// KernelRequest::energy_conserving: no view gets more light than arrives, whatever the model says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/jit/shading/own_library.h"

namespace nacre {
namespace {

constexpr std::size_t count = 1 << 15;

class EnergyConserving : public OwnLibrary {
 protected:
  EnergyConserving() {
    options_.compile.backend = Backend::jit;
    options_.compile.accuracy = Accuracy::standard;
  }

  std::unique_ptr<MaterialKernels> compiled(const std::string& nodes, bool conserving) {
    options_.kernels.energy_conserving = conserving;
    const auto document = read(nodes + R"(
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)");
    return document == nullptr ? nullptr
                               : system_->compile_material(*document, "M", options_, diagnostics_);
  }

  /// The channels of `kernel` at many points of one view; `given` over what is 0.
  static std::map<std::string, std::vector<float>> run_many(
      const BoundKernel& kernel, const std::map<std::string, std::vector<float>>& given) {
    const Program& program = kernel.program();
    std::vector<std::vector<float>> columns;
    for (const Channel& channel : program.inputs) {
      const auto found = given.find(channel.name);
      columns.push_back(found != given.end() ? found->second : std::vector<float>(count, 0.0f));
    }
    std::vector<const void*> in;
    for (const auto& column : columns) in.push_back(column.data());
    std::map<std::string, std::vector<float>> results;
    std::vector<void*> out;
    for (const Channel& channel : program.outputs) {
      out.push_back(results.emplace(channel.name, std::vector<float>(count)).first->second.data());
    }
    EXPECT_EQ(kernel.run(in, out, count), RunStatus::done);
    return results;
  }

  /// Mean weight of samples: what a white world sends to a view.
  static double light(const MaterialKernels& kernels, double angle) {
    const double theta = angle * 0.017453292519943295;
    std::map<std::string, std::vector<float>> given;
    const auto fill = [&](const char* name, double value) {
      given[name].assign(count, static_cast<float>(value));
    };
    for (const char* one : {"N.z", "Ng.z", "T.x", "B.y"}) fill(one, 1.0);
    fill("wo.x", std::sin(theta));
    fill("wo.z", std::cos(theta));
    if (kernels.begin) {
      for (auto& [name, column] : run_many(*kernels.begin, given)) given[name] = column;
    }
    // Roberts' sequence: powers of the root of x^4 = x + 1.
    const std::pair<const char*, double> steps[] = {
        {"u.x", 0.8191725133961645}, {"u.y", 0.6710436067037893}, {"u.z", 0.5497004779019703}};
    for (const auto& [name, step] : steps) {
      std::vector<float>& u = given[name];
      u.resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        u[i] = std::min(static_cast<float>(std::fmod(0.5 + step * static_cast<double>(i), 1.0)),
                        0x1.fffffep-1f);
      }
    }
    const auto out = run_many(*kernels.sample, given);
    double most = 0.0;
    for (const char* channel : {"weight.x", "weight.y", "weight.z"}) {
      double sum = 0.0;
      for (const float weight : out.at(channel)) sum += weight;
      most = std::max(most, sum / count);
    }
    return most;
  }

  double most_light(const std::string& nodes, bool conserving) {
    const auto kernels = compiled(nodes, conserving);
    if (kernels == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), 0.0;
    double most = 0.0;
    for (const double angle : {0.0, 45.0, 75.0, 85.0, 88.0, 89.0, 89.9}) {
      most = std::max(most, light(*kernels, angle));
    }
    return most;
  }
};

// Burley 2012: up to 1.4 where samples are drawn by the cosine; and what adds closures up.
TEST_F(EnergyConserving, ModelsThatExceed) {
  const std::string white = value_of("color", "color3", "1, 1, 1");
  const std::string rough = value_of("roughness", "float", "1");
  const auto surface = node("surface", "surfaceshader", "s", from("bsdf", "BSDF", "b"));
  const std::string burley = node("burley_diffuse_bsdf", "BSDF", "b", white + rough) + surface;
  const std::string twice =
      node("burley_diffuse_bsdf", "BSDF", "x", white) + node("sheen_bsdf", "BSDF", "y", white) +
      node("add", "BSDF", "b", from("in1", "BSDF", "x") + from("in2", "BSDF", "y")) + surface;
  for (const std::string& nodes : {burley, twice}) {
    EXPECT_GT(most_light(nodes, false), 1.3);
    EXPECT_LE(most_light(nodes, true), 1.01);
  }
}

TEST_F(EnergyConserving, ShadingModels) {
  const std::string white = "1, 1, 1";
  const std::pair<const char*, std::string> models[] = {
      {"disney_principled",
       value_of("baseColor", "color3", white) + value_of("roughness", "float", "1")},
      {"open_pbr_surface", value_of("base_color", "color3", white) +
                               value_of("base_diffuse_roughness", "float", "1") +
                               value_of("specular_roughness", "float", "1")},
      {"gltf_pbr", value_of("base_color", "color3", white) + value_of("roughness", "float", "1") +
                       value_of("metallic", "float", "0")},
      {"standard_surface", value_of("base_color", "color3", white) +
                               value_of("base", "float", "1") + value_of("sheen", "float", "1") +
                               value_of("specular_roughness", "float", "1")}};
  for (const auto& [model, inputs] : models) {
    const std::string nodes = node(model, "surfaceshader", "s", inputs);
    fmt::print("| {} | {:.4f} | {:.4f} |\n", model, most_light(nodes, false),
               most_light(nodes, true));
    EXPECT_LE(most_light(nodes, true), 1.01) << model;
  }
}

// What does not exceed stays as it is, to the bit.
TEST_F(EnergyConserving, OthersStayAsTheyAre) {
  const std::string nodes =
      node("conductor_bsdf", "BSDF", "b", value_of("roughness", "vector2", "0.3, 0.3")) +
      node("surface", "surfaceshader", "s", from("bsdf", "BSDF", "b"));
  const auto plain = compiled(nodes, false);
  const auto conserving = compiled(nodes, true);
  ASSERT_TRUE(plain != nullptr && conserving != nullptr) << diagnostics_.to_string();
  for (const double angle : {0.0, 60.0, 88.0}) {
    EXPECT_EQ(light(*plain, angle), light(*conserving, angle)) << angle;
  }
}

}  // namespace
}  // namespace nacre
