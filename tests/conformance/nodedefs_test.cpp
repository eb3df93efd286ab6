#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>

#include "examples/common/materialx_libraries.h"
#include "jit/shading/shading_system.h"
#include "tests/conformance/sweep.h"

namespace nacre {
namespace {

using testing::Arrays;
using testing::edge_values;
using testing::run;
using testing::Sweep;

/// What has no kernel: text is for the graph alone; a material is its shaders, which
/// are asked for.
const std::set<std::string>& without_kernels() {
  static const std::set<std::string> names{
      "ND_UsdPrimvarReader_filename",
      "ND_UsdPrimvarReader_string",
      "ND_constant_filename",
      "ND_constant_string",
      "ND_dot_filename",
      "ND_dot_string",
      "ND_geompropvalueuniform_filename",
      "ND_geompropvalueuniform_string",
      "ND_lama_surface",
      "ND_lightmaterial",
      "ND_surfacematerial",
      "ND_volumematerial",
  };
  return names;
}

bool has_kernel(const NodeDef& def) {
  return std::ranges::all_of(def.outputs, [](const NodeDefOutput& output) {
    return is_numeric(output.type) || is_closure(output.type) ||
           (output.type >= Type::surfaceshader && output.type <= Type::lightshader);
  });
}

constexpr std::size_t points = 37;  ///< Two blocks of sixteen lanes and a tail.

bool is_unimplemented(const Diagnostics& diagnostics) {
  return std::ranges::any_of(diagnostics.all(), [](const Diagnostic& diagnostic) {
    return diagnostic.code == "no-implementation";
  });
}

bool is_finite(const Arrays& arrays, const Program& program) {
  for (const Channel& channel : program.outputs) {
    if (channel.type != Scalar::f32) continue;
    for (const std::uint32_t bits : arrays.at(channel.name)) {
      if (!std::isfinite(std::bit_cast<float>(bits))) return false;
    }
  }
  return true;
}

class NodeDefs : public ::testing::Test {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  static ShaderOptions options(Backend backend) {
    ShaderOptions result;
    result.compile.backend = backend;
    return result;
  }

  void check_values(const NodeDef& def, const Graph& graph) {
    Diagnostics problems;
    const auto interpreted =
        system_->compile_outputs(graph, options(Backend::interpreter), problems);
    const auto compiled = system_->compile_outputs(graph, options(Backend::jit), problems);
    const auto exact = system_->compile_outputs(graph, options(Backend::reference), problems);
    ASSERT_TRUE(interpreted && compiled && exact) << def.name << problems.to_string();
    const Arrays expected = run(interpreted->kernel, {}, points);
    EXPECT_EQ(run(compiled->kernel, {}, points), expected) << def.name;
    EXPECT_TRUE(is_finite(expected, interpreted->kernel.program())) << def.name;
    EXPECT_TRUE(is_finite(run(exact->kernel, {}, points), exact->kernel.program())) << def.name;
  }

  void check_surface(const NodeDef& def, const Graph& graph) {
    Diagnostics problems;
    const auto interpreted =
        system_->compile_material(graph, options(Backend::interpreter), problems);
    const auto compiled = system_->compile_material(graph, options(Backend::jit), problems);
    const auto exact = system_->compile_material(graph, options(Backend::reference), problems);
    ASSERT_TRUE(interpreted && compiled && exact) << def.name << problems.to_string();
    Arrays state;
    Arrays exact_state;
    if (interpreted->begin) {
      state = run(*interpreted->begin, {}, points);
      EXPECT_EQ(run(*compiled->begin, {}, points), state) << def.name;
      exact_state = run(*exact->begin, {}, points);
    }
    const auto check = [&](const char* name, std::optional<BoundKernel> MaterialKernels::* kernel) {
      const auto& a = *interpreted.*kernel;
      const auto& b = *compiled.*kernel;
      const auto& c = *exact.*kernel;
      ASSERT_EQ(a.has_value(), b.has_value()) << def.name << ' ' << name;
      ASSERT_EQ(a.has_value(), c.has_value()) << def.name << ' ' << name;
      if (!a) return;
      const Arrays expected = run(*a, state, points);
      EXPECT_EQ(run(*b, state, points), expected) << def.name << ' ' << name;
      EXPECT_TRUE(is_finite(expected, a->program())) << def.name << ' ' << name;
      EXPECT_TRUE(is_finite(run(*c, exact_state, points), c->program())) << def.name << ' ' << name;
    };
    check("evaluate", &MaterialKernels::evaluate);
    check("sample", &MaterialKernels::sample);
    check("albedo", &MaterialKernels::albedo);
    check("emission", &MaterialKernels::emission);
    check("opacity", &MaterialKernels::opacity);
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

/// MaterialX 1.39.5 has 807 nodedefs: the 806 here and osl_set_ci, which is for the
/// target genosl alone and lies in that target's folder, which is not read. The 817
/// of 1.39.6 are these and mincomponent and maxcomponent, five types each.
TEST_F(NodeDefs, TheLibraryIsReadWhole) {
  const Definitions& definitions = system_->library().definitions();
  EXPECT_EQ(definitions.all().size(), 806u + 40u);  // And those of pbs/library.
  EXPECT_TRUE(definitions.of_category("osl_set_ci").empty());
  EXPECT_TRUE(definitions.of_category("mincomponent").empty());
}

/// What leaves the floats for finite inputs because its formula does: e^89; octaves
/// each 1e8 times the last; and a frame whose vectors are 1e8 long instead of unit.
bool overflows(std::string_view category) {
  return category == "exp" || category == "fractal2d" || category == "fractal3d" ||
         category == "hextilednormalmap";
}

/// Every native body over the edges of what floats can be: no engine hangs, compiled
/// code and interpreter agree in every bit, and finite numbers up to 1e8 in size, zeros
/// and denormals among them, give finite results on all three engines.
TEST_F(NodeDefs, NativeNodesAreDefinedAtTheEdges) {
  constexpr std::size_t count = 997;
  const Definitions& definitions = system_->library().definitions();
  int checked = 0;
  for (const NodeDef* def : definitions.all()) {
    if (!system_->graph_options({}).is_native(def->name)) continue;
    const bool values = std::ranges::all_of(
        def->outputs, [](const NodeDefOutput& output) { return is_numeric(output.type); });
    if (!values) continue;
    ++checked;
    Diagnostics problems;
    const auto graph = Sweep(system_->library(), *def).finish(system_->graph_options({}), problems);
    ASSERT_TRUE(graph) << def->name << problems.to_string();
    const auto interpreted =
        system_->compile_outputs(*graph, options(Backend::interpreter), problems);
    const auto compiled = system_->compile_outputs(*graph, options(Backend::jit), problems);
    const auto exact = system_->compile_outputs(*graph, options(Backend::reference), problems);
    ASSERT_TRUE(interpreted && compiled && exact) << def->name << problems.to_string();
    for (const bool wild : {false, true}) {
      Arrays inputs;
      for (const Channel& channel : interpreted->kernel.program().inputs) {
        inputs[channel.name] = edge_values(channel, wild, count);
      }
      const Arrays expected = run(interpreted->kernel, inputs, count);
      EXPECT_EQ(run(compiled->kernel, inputs, count), expected) << def->name;
      const Arrays in_double = run(exact->kernel, inputs, count);
      if (wild || overflows(def->category)) continue;
      EXPECT_TRUE(is_finite(expected, interpreted->kernel.program())) << def->name;
      EXPECT_TRUE(is_finite(in_double, interpreted->kernel.program())) << def->name;
    }
  }
  EXPECT_GT(checked, 400);
}

TEST_F(NodeDefs, EachRunsOnAllEnginesWithVaryingInputs) {
  std::set<std::string> without;
  int run = 0;
  for (const NodeDef* def : system_->library().definitions().all()) {
    Diagnostics problems;
    std::optional<Graph> graph;
    if (has_kernel(*def)) {
      graph = Sweep(system_->library(), *def).finish(system_->graph_options({}), problems);
      ASSERT_TRUE(graph) << def->name << problems.to_string();
    }
    if (!graph || is_unimplemented(problems) ||
        graph->outputs.front().source.kind == Source::Kind::unconnected) {
      without.insert(std::string(def->name));
      continue;
    }
    const bool is_surface = graph->outputs.front().type == Type::surfaceshader;
    is_surface ? check_surface(*def, *graph) : check_values(*def, *graph);
    ++run;
  }
  EXPECT_EQ(without, without_kernels());
  EXPECT_EQ(run, 834);  // 795 of the data library, 39 of pbs/library.
}

}  // namespace
}  // namespace nacre
