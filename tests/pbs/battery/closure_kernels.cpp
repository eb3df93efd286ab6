#include "tests/pbs/battery/closure_kernels.h"

#include <gtest/gtest.h>

#include "jit/graph/build/builder.h"
#include "pbs/exterior.h"
#include "tests/support/standard_library.h"

namespace nacre {

namespace {

using Node = GraphBuilder::Node;

bool is_shader(Type type) {
  return type == Type::surfaceshader || type == Type::displacementshader ||
         type == Type::volumeshader || type == Type::lightshader;
}

Value value_of(const NodeDefInput& input, std::string_view text) {
  if (input.type == Type::boolean) return {input.type, {}, {text == "true" ? 1 : 0}, {}};
  return {input.type, {}, {}, {std::string(text)}};
}

/// A graph around one node whose every number is a parameter.
class ClosureGraph {
 public:
  explicit ClosureGraph(const ClosureCase& row)
      : row_(row), library_(closure_system().library()), builder_(library_) {}

  std::optional<Graph> build(const std::vector<Setting>& form, Diagnostics& diagnostics) {
    const Node node = add(row_.nodedef, "n", form);
    const Type type = library_.definitions().nodedef(row_.nodedef)->outputs.front().type;
    is_surface_ = type == Type::bsdf || type == Type::edf || type == Type::surfaceshader;
    if (type == Type::bsdf || type == Type::edf) {
      const Node surface = builder_.add_node("ND_surface", "surface");
      builder_.connect(surface, type == Type::bsdf ? "bsdf" : "edf", node);
      builder_.output("surfaceshader", surface);
    } else {
      builder_.output(is_surface_ ? "surfaceshader" : "out", node);
    }
    return builder_.finish(closure_system().graph_options({}), diagnostics);
  }

  bool is_surface() const { return is_surface_; }
  std::vector<ClosureInput> take_inputs() { return std::move(inputs_); }

 private:
  Node add(std::string_view nodedef, const std::string& path, const std::vector<Setting>& form) {
    const Node node = builder_.add_node(nodedef, path);
    const NodeDef* const def = library_.definitions().nodedef(nodedef);
    if (def == nullptr) return node;
    for (const NodeDefInput& input : def->inputs) {
      const auto set =
          std::ranges::find_if(form, [&](const Setting& each) { return each.first == input.name; });
      if (set != form.end()) {
        builder_.set(node, input.name, value_of(input, set->second));
      } else if (is_numeric(input.type)) {
        builder_.connect(node, input.name, number(input, path));
      } else if (is_closure(input.type) || is_shader(input.type)) {
        builder_.connect(node, input.name,
                         closure(input.type, input.name, path + '/' + std::string(input.name)));
      }
    }
    return node;
  }

  GraphBuilder::ParameterId number(const NodeDefInput& input, const std::string& path) {
    const std::string name = path + '/' + std::string(input.name);
    const bool is_color = input.type == Type::color3 || input.type == Type::color4;
    inputs_.push_back({name, input.type, meaning_of(row_, input.name, is_color)});
    Value value{input.type, {}, {}, {}};
    const auto count = static_cast<std::size_t>(component_count(input.type));
    const bool is_whole = input.type == Type::boolean || input.type == Type::integer;
    is_whole ? value.ints.assign(count, 0) : value.floats.assign(count, 0.0f);
    return builder_.parameter(name, value);
  }

  /// What is on top or in front is glass that is seen through, what is below is paint.
  Node closure(Type type, std::string_view input, const std::string& path) {
    const bool below = input == "base" || input == "bg" || input == "in2" || input == "material2" ||
                       input == "materialBase";
    switch (type) {
      case Type::bsdf:
        return below ? add("ND_oren_nayar_diffuse_bsdf", path, {})
                     : add("ND_dielectric_bsdf", path, {{"scatter_mode", "RT"}});
      case Type::edf: return add("ND_uniform_edf", path, {});
      case Type::vdf: return add("ND_anisotropic_vdf", path, {});
      case Type::surfaceshader: {
        const Node surface = builder_.add_node("ND_surface", path);
        builder_.connect(surface, "bsdf", closure(Type::bsdf, input, path + "/bsdf"));
        builder_.connect(surface, "edf", closure(Type::edf, input, path + "/edf"));
        const NodeDef* const def = library_.definitions().nodedef("ND_surface");
        builder_.connect(surface, "opacity", number(*def->input("opacity"), path));
        return surface;
      }
      case Type::displacementshader: return add("ND_displacement_vector3", path, {});
      case Type::volumeshader: return add("ND_volume", path, {});
      default: return add("ND_point_light", path, {});
    }
  }

  const ClosureCase& row_;
  const Library& library_;
  GraphBuilder builder_;
  std::vector<ClosureInput> inputs_;
  bool is_surface_ = false;
};

KernelRequest request_of(const ClosureWay& way) {
  KernelRequest request;
  request.entries = entry_begin | entry_sample | entry_evaluate | entry_albedo | entry_emission |
                    entry_opacity | entry_interior | entry_shadow | entry_emit;
  request.reverse_pdf = true;
  request.with_begin = {"normal", "roughness"};
  if (!way.asks_all) return request;
  request.entries |= entry_subsurface;
  request.lobe_mask = request.min_alpha = request.energy_conserving = true;
  request.by_lobe = request.lobes_wanted = request.transport = true;
  return request;
}

}  // namespace

ShadingSystem& closure_system() {
  static const std::unique_ptr<ShadingSystem> system = [] {
    Diagnostics diagnostics;
    auto made = ShadingSystem::create(
        {.libraries = {standard_library_folder()}, .compile_threads = 1}, diagnostics);
    if (made == nullptr) {
      ADD_FAILURE() << diagnostics.to_string();
      std::exit(1);
    }
    return made;
  }();
  return *system;
}

std::string to_string(const ClosureWay& way) {
  std::string text(accuracy_name(way.accuracy));
  if (way.backend == Backend::interpreter) text += "_interpreted";
  if (way.asks_all) text += "_asking_all";
  return text;
}

ClosureKernels compile_closure(const ClosureCase& row, const std::vector<Setting>& form,
                               const ClosureWay& way) {
  ClosureKernels made;
  made.way = way;
  ClosureGraph graph(row);
  const std::optional<Graph> built = graph.build(form, made.diagnostics);
  if (!built) return made;
  made.inputs = graph.take_inputs();
  ShaderOptions options;
  options.compile.accuracy = way.accuracy;
  options.compile.backend = way.backend;
  options.compile.max_seconds = 600;
  for (const ClosureInput& input : made.inputs) options.live.push_back(input.name);
  options.varying = {"*"};
  if (way.asks_all) options.varying.emplace_back(exterior_index_channel);
  options.footprints = false;
  options.kernels = request_of(way);
  if (graph.is_surface()) {
    made.material = closure_system().compile_material(*built, options, made.diagnostics);
  } else {
    made.values = closure_system().compile_outputs(*built, options, made.diagnostics);
  }
  return made;
}

std::string to_string(const std::vector<Setting>& form) {
  std::string text;
  for (const auto& [input, value] : form) {
    text += text.empty() ? "" : " ";
    text += std::string(input) + "=" + std::string(value);
  }
  return text.empty() ? "defaults" : text;
}

Arrays run(const BoundKernel& kernel, const Arrays& in, std::size_t count) {
  const Program& program = kernel.program();
  const std::vector<std::uint32_t> zeros(count, 0);
  std::vector<const void*> inputs;
  for (const Channel& channel : program.inputs) {
    const auto given = in.find(channel.name);
    EXPECT_NE(given, in.end()) << channel.name;
    inputs.push_back(given == in.end() ? zeros.data() : given->second.data());
  }
  Arrays out;
  std::vector<void*> outputs;
  for (const Channel& channel : program.outputs) {
    std::vector<std::uint32_t>& array = out[channel.name];
    array.resize(count);
    outputs.push_back(array.data());
  }
  EXPECT_EQ(kernel.run(inputs, outputs, count), RunStatus::done);
  return out;
}

}  // namespace nacre
