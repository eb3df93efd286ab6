#include "examples/tool/render/shaders.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "examples/render/mesh.h"
#include "examples/render/nested_solids.h"
#include "examples/tool/render/neutral.h"
#include "examples/tool/render/not_rendered.h"
#include "examples/tool/render/technique_options.h"
#include "examples/tool/render/varying_slots.h"
#include "examples/tool/scene/facts.h"
#include "jit/document/inheritance.h"
#include "jit/document/select.h"
#include "jit/graph/resolve/filename.h"

namespace nacre::tool {

namespace {

/// Whether what enters any of them by one side leaves by another.
bool are_solids(const std::vector<const host::Mesh*>& meshes) {
  return std::ranges::all_of(meshes, [](const host::Mesh* mesh) { return host::is_closed(*mesh); });
}

/// Whether a name of a file below has the number of a frame in it.
bool names_frames(const Element& element) {
  return has_frame_token(element.attribute("value")) ||
         std::ranges::any_of(element.children(), names_frames);
}

bool is_of_material(const Opened& opened, const Element& light) {
  return std::ranges::any_of(opened.document->root().children(), [&](const Element& material) {
    const Element* input =
        material.category() == "lightmaterial" ? find_input(material, "lightshader") : nullptr;
    return input != nullptr && input->attribute("nodename") == light.name();
  });
}

/// Whether there is something to render, for one mesh or another; an error otherwise.
bool check_material(const std::string& material, const MaterialKernels& kernels,
                    Diagnostics& diagnostics) {
  if (!kernels.has_surface && kernels.light && has_place(kernels.light->program())) {
    diagnostics.error(
        "light-has-place", {},
        "material '" + material + "' is a light that stands somewhere by itself, and no mesh's",
        "a <light>, which is where its mesh is");
    return false;
  }
  if (!kernels.has_surface && !kernels.has_light && !kernels.has_volume) {
    diagnostics.error("no-surface", {},
                      "material '" + material + "' has no surface, and nothing else is rendered",
                      "a surface, a volume or a light shader");
    return false;
  }
  return true;
}

}  // namespace

/// Kernels of a material, and the meshes that they are for.
struct RenderShaders::Request {
  const MeshAssignment& assignment;
  const std::vector<const host::Mesh*>& meshes;
  int frame = 0;
  bool is_nested = false;  ///< They ask what is around.
  bool walks = false;
  std::vector<std::string> varying = {};

  /// The same for those that the same kernels serve.
  std::string key() const {
    std::string text = assignment.key() + '\n' + std::to_string(frame);
    for (const bool flag : {is_nested, walks}) text += flag ? " 1" : " 0";
    for (const std::string& slot : varying) text += ' ' + slot;
    return text;
  }
};

std::vector<const BoundKernel*> SceneShaders::kernels() const {
  std::vector<const BoundKernel*> kernels = neutral->kernels();
  for (const KernelLight* light : lights) kernels.push_back(&light->kernel().kernel);
  std::set<const TwoShaders*> met{nullptr};
  for (const TwoShaders* both : by_mesh) {
    if (!met.insert(both).second) continue;
    for (const KernelShader* shader : both->all()) {
      const std::vector<const BoundKernel*> more = shader->kernels();
      kernels.insert(kernels.end(), more.begin(), more.end());
    }
  }
  return kernels;
}

RenderShaders::RenderShaders(RenderOptions& options, const Opened& opened, RenderStop& stop)
    : options_(options),
      opened_(opened),
      stop_(stop),
      names_frames_(names_frames(opened.document->root()) ||
                    names_frames(opened.system->library().document().root())) {}

std::optional<SceneShaders> RenderShaders::of(const host::Scene& world,
                                              const std::vector<MeshAssignment>& assignments,
                                              float frame, Diagnostics& diagnostics) {
  std::map<std::string, std::vector<const host::Mesh*>> meshes;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    meshes[assignments[i].key()].push_back(&world.meshes[i]);
  }
  const int number = names_frames_ ? static_cast<int>(std::floor(frame)) : 0;
  std::map<std::string, const TwoShaders*> by_key;
  const auto find_all = [&](const std::set<std::string>& nested) {
    for (const MeshAssignment& each : assignments) {
      const std::string key = each.key();
      if (each.material.empty() || by_key.contains(key)) continue;
      const auto* found =
          find({each, meshes.at(key), number, nested.contains(key), options_.walks}, diagnostics);
      if (found == nullptr) return false;
      by_key[key] = found;
    }
    return true;
  };
  if (!find_all({})) return {};
  const auto lets_in = [&](std::uint32_t mesh) {
    const MeshAssignment& each = assignments[mesh];
    return !each.material.empty() && by_key.at(each.key())->front->lets_in();
  };
  const host::NestedSolids around = host::find_nested_solids(world, lets_in);
  std::set<std::string> nested;
  for (std::size_t i = 0; i < around.solid.size(); ++i) {
    if (!around.solid[i] && !around.within[i]) continue;
    nested.insert(assignments[i].key());
    by_key.erase(assignments[i].key());
  }
  if (!find_all(nested) || !compile_lights(number, diagnostics) || !make_neutral(diagnostics)) {
    return {};
  }
  SceneShaders found{{}, around.solid, neutral_.get(), {}};
  for (const MeshAssignment& each : assignments) {
    found.by_mesh.push_back(each.material.empty() ? nullptr : by_key.at(each.key()));
  }
  for (const auto& light : lights_.at(number)) found.lights.push_back(light.get());
  return found;
}

/// Null after an error.
const TwoShaders* RenderShaders::find(Request request, Diagnostics& diagnostics) {
  request.varying = varying_slots(request.meshes, host::is_open(options_.settings));
  Made& made = made_[request.key()];
  if (made.shaders.front == nullptr && !made.walks && !make(request, made, diagnostics)) {
    return nullptr;
  }
  if (made.walks && !are_solids(request.meshes)) {
    request.walks = false;
    return find(std::move(request), diagnostics);
  }
  if (made.shaders.front == nullptr && !make(request, made, diagnostics)) return nullptr;
  return &made.shaders;
}

/// False after an error. No shaders where light would be followed through what is not solid.
bool RenderShaders::make(const Request& request, Made& made, Diagnostics& diagnostics) {
  const std::string& material = request.assignment.material;
  made.material = material;
  ShaderOptions shader =
      with_profile(opened_, material, true, options_.common.shader_options(), diagnostics);
  shader.graph.frame = request.frame;
  shader.graph.variants = request.assignment.variants;
  shader.graph.geometry_tokens = request.assignment.tokens;
  shader.kernels.entries |= entry_interior;
  if (request.walks) shader.kernels.entries |= entry_subsurface;
  shader.kernels.energy_conserving = options_.energy_conserving;
  ask_for_passes(options_.settings.passes, shader.kernels);
  shader.varying = request.varying;
  if (request.is_nested) shader.varying.emplace_back("exterior_index");
  ask_for_techniques(options_.settings.techniques, shader);
  std::ranges::move(scene_facts(request.meshes), std::back_inserter(shader.compile.facts));
  const auto compile = [&] {
    return opened_.system->compile_material(*opened_.document, material, shader, diagnostics);
  };
  auto kernels = compile();
  if (kernels == nullptr) return false;
  made.walks = kernels->subsurface.has_value();
  if (made.walks && !are_solids(request.meshes)) return true;
  if (!check_material(material, *kernels, diagnostics)) return false;
  NotRendered not_rendered(opened_, diagnostics);
  not_rendered.look_at_material(material, *kernels);
  look_for_values(*kernels, options_.settings.passes, diagnostics);
  if (kernels->displacement) {
    not_rendered.look_at_displaced(material, request.meshes, options_.dice > 0.0f);
  }
  const bool is_volume = !kernels->has_surface && kernels->volume;
  if (has_medium(*kernels) || is_volume) not_rendered.look_at_solids(material, request.meshes);
  const bool has_back = kernels->has_back;
  const std::vector<host::GraphValue>& values = options_.settings.passes.values;
  const auto bound = [&] {
    return std::make_unique<KernelShader>(std::move(kernels), stop_, request.is_nested, values,
                                          !options_.points_file.empty());
  };
  made.shaders.front = bound();
  if (!has_back) return true;
  shader.side = Side::back;
  kernels = compile();
  if (kernels == nullptr) return false;
  made.shaders.back = bound();
  return true;
}

/// Light shaders of the document that stand somewhere by themselves: those that have a direction.
bool RenderShaders::compile_lights(int frame, Diagnostics& diagnostics) {
  const auto [slot, fresh] = lights_.try_emplace(frame);
  if (!fresh) return true;
  for (const Element& element : opened_.document->root().children()) {
    if (!is_node(element) || element.attribute("type") != "lightshader") continue;
    ShaderOptions shader = options_.common.shader_options();
    shader.graph.frame = frame;
    if (host::is_open(options_.settings)) shader.varying = {"time", "frame"};
    auto kernel = opened_.system->compile_outputs(*opened_.document, {std::string(element.name())},
                                                  shader, diagnostics);
    if (kernel == nullptr) return false;
    if (!has_place(kernel->kernel.program())) {
      if (!is_of_material(opened_, element)) {
        diagnostics.warning("light-without-place", location(element),
                            "the light is nowhere and not rendered",
                            "a <lightmaterial> that is assigned to a mesh");
      }
      continue;
    }
    auto light = KernelLight::create(std::move(kernel), stop_, diagnostics);
    if (light == nullptr) return false;
    slot->second.push_back(std::move(light));
  }
  return true;
}

RecordedPoints RenderShaders::recorded() const {
  std::map<std::string, std::vector<PointsOfMaterial>> by_material;
  for (const auto& [key, made] : made_) {
    for (const KernelShader* shader : made.shaders.all()) {
      if (shader == nullptr || shader->recorder() == nullptr) continue;
      by_material[made.material].push_back(shader->recorder()->points(made.material));
    }
  }
  RecordedPoints all;
  for (auto& [material, points] : by_material) {
    PointsOfMaterial whole = joined(std::move(points));
    if (whole.count > 0) all.add(std::move(whole));
  }
  return all;
}

bool RenderShaders::make_neutral(Diagnostics& diagnostics) {
  if (neutral_ != nullptr) return true;
  ShaderOptions shader = options_.common.shader_options();
  shader.kernels.by_lobe = options_.settings.passes.any(host::PassNeed::split);
  ask_for_techniques(options_.settings.techniques, shader);
  auto grey = neutral_material(*opened_.system, shader, diagnostics);
  if (grey == nullptr) return false;
  neutral_ = std::make_unique<KernelShader>(std::move(grey), stop_);
  return true;
}

void report_failed(const Opened& opened, const std::vector<MeshAssignment>& assignments,
                   const SceneShaders& shaders, Diagnostics& diagnostics) {
  constexpr const char* what = "' takes too many steps for a point, or a loop of it does not end";
  for (const KernelLight* light : shaders.lights) {
    const OutputKernel::Output& output = light->kernel().outputs.front();
    if (!light->has_failed()) continue;
    diagnostics.error("too-many-steps", output.where, "light '" + output.name + what);
  }
  std::set<std::string> said;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const std::string& material = assignments[i].material;
    const TwoShaders* const both = shaders.by_mesh[i];
    if (both == nullptr || !said.insert(material).second) continue;
    if (std::ranges::none_of(both->all(), &KernelShader::has_failed)) continue;
    const Element* element = opened.document->root().child(material);
    diagnostics.error("too-many-steps", element != nullptr ? location(*element) : SourceLocation{},
                      "material '" + material + what);
  }
}

}  // namespace nacre::tool
