#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>

#include "examples/common/materialx_libraries.h"
#include "jit/graph/builder.h"
#include "jit/shading/shading_system.h"
#include "tests/support/random.h"
#include "tests/support/shared.h"

namespace nacre {
namespace {

/// What has no kernel: text is for the graph alone; volumes, displacement and lights
/// have no kernels; a material is its shaders; nothing implements hair or measured
/// light; and a surface shader on its own has nothing to pass on.
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
      "ND_displacement_float",
      "ND_displacement_vector3",
      "ND_dot_displacementshader",
      "ND_mix_displacementshader",
      "ND_absorption_vdf",
      "ND_add_vdf",
      "ND_anisotropic_vdf",
      "ND_dot_volumeshader",
      "ND_mix_vdf",
      "ND_mix_volumeshader",
      "ND_multiply_vdfC",
      "ND_multiply_vdfF",
      "ND_volume",
      "ND_directional_light",
      "ND_dot_lightshader",
      "ND_light",
      "ND_point_light",
      "ND_spot_light",
      "ND_lama_surface",
      "ND_surfacematerial",
      "ND_volumematerial",
      "ND_chiang_hair_bsdf",
      "ND_measured_edf",
      "ND_dot_surfaceshader",
  };
  return names;
}

bool has_kernel(const NodeDef& def) {
  return std::ranges::all_of(def.outputs, [](const NodeDefOutput& output) {
    return is_numeric(output.type) || output.type == Type::bsdf || output.type == Type::edf ||
           output.type == Type::surfaceshader;
  });
}

/// Builds graphs around one nodedef whose every input varies over the surface.
class Sweep {
 public:
  Sweep(const Library& library, const NodeDef& def) : def_(def), builder_(library) {
    node_ = builder_.add_node(def.name, "n");
    for (const NodeDefInput& input : def.inputs) {
      if (!input.uniform && is_numeric(input.type))
        builder_.connect(node_, input.name, varying(input));
      if (is_closure(input.type)) builder_.connect(node_, input.name, closure(input.type));
    }
  }

  std::optional<Graph> finish(const GraphOptions& options, Diagnostics& diagnostics) {
    const Type type = def_.outputs.front().type;
    if (is_closure(type)) {
      const auto surface = builder_.add_node("ND_surface", "surface");
      builder_.connect(surface, type == Type::bsdf ? "bsdf" : "edf", node_);
      builder_.output("surfaceshader", surface);
    } else {
      for (const NodeDefOutput& output : def_.outputs) {
        builder_.output(std::string(output.name), node_, output.name);
      }
    }
    return builder_.finish(options, diagnostics);
  }

 private:
  GraphBuilder::Node geomprop(Type type, const std::string& name) {
    const auto node = builder_.add_node("ND_geompropvalue_" + std::string(type_name(type)), name);
    builder_.set(node, "geomprop", {Type::string, {}, {}, {name}});
    return node;
  }

  GraphBuilder::Node varying(const NodeDefInput& input) {
    const std::string name(input.name);
    if (input.type != Type::matrix33 && input.type != Type::matrix44) {
      return geomprop(input.type, name);
    }
    const bool small = input.type == Type::matrix33;
    const auto matrix = builder_.add_node(
        small ? "ND_creatematrix_vector3_matrix33" : "ND_creatematrix_vector4_matrix44", name);
    for (const char* row : {"in1", "in2", "in3", "in4"}) {
      if (small && row == std::string_view("in4")) continue;
      builder_.connect(matrix, row,
                       geomprop(small ? Type::vector3 : Type::vector4, name + '_' + row));
    }
    return matrix;
  }

  GraphBuilder::Node closure(Type type) {
    if (type == Type::bsdf) return builder_.add_node("ND_oren_nayar_diffuse_bsdf", "bsdf");
    if (type == Type::edf) return builder_.add_node("ND_uniform_edf", "edf");
    return builder_.add_node("ND_absorption_vdf", "vdf");
  }

  const NodeDef& def_;
  GraphBuilder builder_;
  GraphBuilder::Node node_;
};

/// Arrays by channel, as the four-byte elements that kernels read and write.
using Arrays = std::map<std::string, std::vector<std::uint32_t>>;

constexpr std::size_t points = 37;  ///< Two blocks of sixteen lanes and a tail.

/// What a channel holds: a frame and two directions for a surface, else numbers
/// between -2 and 2, whole numbers 0 to 3, and truth values.
std::vector<std::uint32_t> fill(const Channel& channel) {
  static const std::map<std::string, float> fixed{
      {"N.x", 0.0f},  {"N.y", 0.0f},  {"N.z", 1.0f},  {"T.x", 1.0f},  {"T.y", 0.0f},
      {"T.z", 0.0f},  {"B.x", 0.0f},  {"B.y", 1.0f},  {"B.z", 0.0f},  {"Ng.x", 0.0f},
      {"Ng.y", 0.0f}, {"Ng.z", 1.0f}, {"wo.x", 0.6f}, {"wo.y", 0.0f}, {"wo.z", 0.8f},
      {"wi.x", 0.0f}, {"wi.y", 0.6f}, {"wi.z", 0.8f}};
  std::uint64_t seed = 1469598103934665603ull;
  for (const char c : channel.name)
    seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  Random random(seed);
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < points; ++i) {
    const std::uint32_t number = random.below(4096);
    if (channel.type == Scalar::f32) {
      float value = static_cast<float>(number) / 1024.0f - 2.0f;
      if (channel.name.starts_with("u.")) value = static_cast<float>(number) / 4096.0f;
      if (const auto known = fixed.find(channel.name); known != fixed.end()) value = known->second;
      values.push_back(std::bit_cast<std::uint32_t>(value));
    } else {
      values.push_back(channel.type == Scalar::b1 ? number & 1 : number & 3);
    }
  }
  return values;
}

/// Every geometric property is there, so that inputs do vary.
Arrays run(const BoundKernel& kernel, const Arrays& known = {}, std::size_t count = points) {
  const Program& program = kernel.program();
  std::vector<std::uint32_t> parameters = kernel.parameters();
  for (std::size_t i = 0; i < program.parameters.size(); ++i) {
    if (program.parameters[i].name.starts_with("geomprop.")) parameters[i] = 1;
  }
  std::vector<std::vector<std::uint32_t>> inputs;
  std::vector<const void*> in;
  for (const Channel& channel : program.inputs) {
    const auto given = known.find(channel.name);
    inputs.push_back(given == known.end() ? fill(channel) : given->second);
  }
  for (const auto& values : inputs) in.push_back(values.data());
  Arrays outputs;
  std::vector<void*> out;
  for (const Channel& channel : program.outputs) {
    outputs[channel.name].resize(count);
    out.push_back(outputs[channel.name].data());
  }
  kernel.run(in, out, count, parameters);
  return outputs;
}

bool is_unimplemented(const Diagnostics& diagnostics) {
  return std::ranges::any_of(diagnostics.all(), [](const Diagnostic& diagnostic) {
    return diagnostic.code == "no-implementation";
  });
}

/// Zeros, denormals, whole and huge numbers; with `wild` also what is not finite and
/// what overflows when squared. Each channel goes through them in an order of its own.
std::vector<std::uint32_t> edge_values(const Channel& channel, bool wild, std::size_t count) {
  using Limits = std::numeric_limits<float>;
  std::vector<float> numbers{0.0f,  -0.0f,  1.0f,    -1.0f, Limits::denorm_min(),
                             0.5f,  -0.5f,  2.0f,    3.0f,  -7.0f,
                             1e-7f, -1e-7f, 100.25f, 1e6f,  -1e8f,
                             1e8f};
  if (wild) {
    for (const float x : {1e30f, -1e30f, Limits::max(), Limits::infinity(), -Limits::infinity(),
                          Limits::quiet_NaN(), Limits::min()}) {
      numbers.push_back(x);
    }
  }
  const std::vector<std::int32_t> integers{0, 1, -1, 2, 7, 1000, INT32_MAX, INT32_MIN};
  std::uint64_t seed = 1469598103934665603ull;
  for (const char c : channel.name)
    seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  Random random(seed);
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    if (channel.type == Scalar::f32) {
      values.push_back(std::bit_cast<std::uint32_t>(random.pick(numbers)));
    } else if (channel.type == Scalar::i32) {
      values.push_back(static_cast<std::uint32_t>(random.pick(integers)));
    } else {
      values.push_back(random.below(2));
    }
  }
  return values;
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
    const Arrays expected = run(interpreted->kernel);
    EXPECT_EQ(run(compiled->kernel), expected) << def.name;
    EXPECT_TRUE(is_finite(expected, interpreted->kernel.program())) << def.name;
    EXPECT_TRUE(is_finite(run(exact->kernel), exact->kernel.program())) << def.name;
  }

  void check_surface(const NodeDef& def, const Graph& graph) {
    Diagnostics problems;
    const auto interpreted =
        system_->compile_material(graph, options(Backend::interpreter), problems);
    const auto compiled = system_->compile_material(graph, options(Backend::jit), problems);
    ASSERT_TRUE(interpreted && compiled) << def.name << problems.to_string();
    Arrays state;
    if (interpreted->begin) {
      state = run(*interpreted->begin);
      EXPECT_EQ(run(*compiled->begin), state) << def.name;
    }
    const auto check = [&](const char* name, const std::optional<BoundKernel>& a,
                           const std::optional<BoundKernel>& b) {
      ASSERT_EQ(a.has_value(), b.has_value()) << def.name << ' ' << name;
      if (!a) return;
      const Arrays expected = run(*a, state);
      EXPECT_EQ(run(*b, state), expected) << def.name << ' ' << name;
      EXPECT_TRUE(is_finite(expected, a->program())) << def.name << ' ' << name;
    };
    check("evaluate", interpreted->evaluate, compiled->evaluate);
    check("sample", interpreted->sample, compiled->sample);
    check("albedo", interpreted->albedo, compiled->albedo);
    check("emission", interpreted->emission, compiled->emission);
    check("opacity", interpreted->opacity, compiled->opacity);
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

/// MaterialX 1.39.5 has 807 nodedefs: the 806 here and osl_set_ci, which is for the
/// target genosl alone and lies in that target's folder, which is not read. The 817
/// of 1.39.6 are these and mincomponent and maxcomponent, five types each.
TEST_F(NodeDefs, TheLibraryIsReadWhole) {
  const Definitions& definitions = system_->library().definitions();
  EXPECT_EQ(definitions.all().size(), 806u);
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
  EXPECT_EQ(run, 774);
}

}  // namespace
}  // namespace nacre
