#include "tests/pbs/edf/emission_kernels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "jit/document/read.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace nacre {

namespace {

ShadingSystem& shading_system() {
  static const std::unique_ptr<ShadingSystem> system = [] {
    Diagnostics diagnostics;
    return ShadingSystem::create(
        {.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}, .compile_threads = 1}, diagnostics);
  }();
  return *system;
}

void put(EmissionColumns& columns, const std::string& group, double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  columns[group + ".x"] = {static_cast<float>(x / length)};
  columns[group + ".y"] = {static_cast<float>(y / length)};
  columns[group + ".z"] = {static_cast<float>(z / length)};
}

}  // namespace

EmissionKernels::EmissionKernels(const EmissionCase& row, const ShaderOptions& options) {
  const TemporaryFolder folder;
  if (!row.profile.empty()) folder.write("light.ies", row.profile);
  const bool is_surface = row.nodes.find("\"s\"") != std::string::npos;
  const std::string surface =
      R"(<surface name="s" type="surfaceshader"><input name="edf" type="EDF" nodename="e"/></surface>)";
  const std::string path =
      folder.write("test.mtlx", "<materialx version=\"1.39\">" + row.nodes +
                                    (is_surface ? std::string() : surface) +
                                    R"(<surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial></materialx>)");
  Diagnostics diagnostics;
  const auto document = read_document(path, {}, diagnostics);
  if (document != nullptr) {
    material_ = shading_system().compile_material(*document, "M", options, diagnostics);
  }
  EXPECT_TRUE(material_ != nullptr && !diagnostics.has_errors()) << diagnostics.to_string();
}

EmissionColumns EmissionKernels::run(const BoundKernel& kernel, const EmissionColumns& in,
                                     std::size_t count) {
  const Program& program = kernel.program();
  std::vector<std::vector<float>> columns;
  for (const Channel& channel : program.inputs) {
    const auto given = in.find(channel.name);
    std::vector<float> column = given == in.end() ? std::vector<float>{0.0f} : given->second;
    if (column.size() == 1) column.resize(count, column.front());
    columns.push_back(std::move(column));
  }
  std::vector<const void*> inputs;
  for (const auto& column : columns) inputs.push_back(column.data());
  EmissionColumns out;
  std::vector<void*> outputs;
  for (const Channel& channel : program.outputs) {
    std::vector<float>& column = out[channel.name];
    column.resize(count);
    outputs.push_back(column.data());
  }
  EXPECT_EQ(kernel.run(inputs, outputs, count), RunStatus::done);
  return out;
}

EmissionColumns EmissionKernels::emit(const EmissionColumns& point, std::size_t count,
                                      std::uint64_t seed) const {
  EmissionColumns in = point;
  Random random(seed);
  for (const char* name : {"u.x", "u.y", "u.z"}) {
    std::vector<float>& column = in[name];
    for (std::size_t i = 0; i < count; ++i) {
      column.push_back(static_cast<float>(random.word() >> 40) * 0x1p-24f);
    }
  }
  return run(*material_->emit, in, count);
}

EmissionColumns EmissionKernels::emission(EmissionColumns point,
                                          const std::vector<Direction>& wo) const {
  for (const char* k : {"x", "y", "z"}) point[std::string("wo.") + k].clear();
  for (const Direction& w : wo) {
    point["wo.x"].push_back(w.x), point["wo.y"].push_back(w.y), point["wo.z"].push_back(w.z);
  }
  return run(*material_->emission, point, wo.size());
}

ShaderOptions emission_options(Accuracy accuracy, Backend backend, int lanes) {
  ShaderOptions options;
  options.compile.accuracy = accuracy;
  options.compile.backend = backend;
  options.compile.lanes = lanes;
  options.kernels.entries = entry_emission | entry_emit;
  return options;
}

EmissionColumns upright_point() {
  EmissionColumns point;
  put(point, "N", 0, 0, 1), put(point, "Ng", 0, 0, 1), put(point, "T", 1, 0, 0);
  return point;
}

EmissionColumns tilted_point() {
  EmissionColumns point;
  put(point, "N", 0.3, -0.2, 0.8), put(point, "Ng", -0.4, 0.1, 0.9), put(point, "T", 0.2, 0.9, 0.1);
  return point;
}

Direction direction_of(const EmissionColumns& columns, const std::string& group, std::size_t i) {
  return {columns.at(group + ".x")[i], columns.at(group + ".y")[i], columns.at(group + ".z")[i]};
}

}  // namespace nacre
