#include "examples/tool/render/moment.h"

#include <algorithm>
#include <utility>

#include "examples/tool/render/missing_attributes.h"
#include "examples/tool/render/missing_material.h"
#include "examples/tool/scene/materials.h"

namespace nacre::tool {

RenderMoment::RenderMoment(host::Scene world, const host::RenderSettings& settings)
    : world_(std::move(world)), settings_(settings) {}

std::unique_ptr<RenderMoment> RenderMoment::create(const RenderOptions& options,
                                                   const Opened& opened, host::Scene world,
                                                   const host::Environment& environment,
                                                   RenderShaders& shaders,
                                                   Diagnostics& diagnostics) {
  std::unique_ptr<RenderMoment> made(new RenderMoment(std::move(world), options.settings));
  if (!made->assign(options, opened, shaders, diagnostics)) return nullptr;
  // Values of graphs are known by now.
  made->settings_.passes = options.settings.passes;
  made->input_.scene = &made->world_;
  made->input_.environment = &environment;
  for (const KernelLight* light : made->shaders_.lights) made->input_.lights.push_back(light);
  const std::vector<host::PunctualLight>& shining = made->world_.lights;
  made->punctual_ = std::vector<host::PunctualShader>(shining.begin(), shining.end());
  for (const host::PunctualShader& light : made->punctual_) made->input_.lights.push_back(&light);
  if (!made->complete_passes(options.passes, diagnostics)) return nullptr;
  made->bind(options.scene, diagnostics);
  return made;
}

bool RenderMoment::assign(const RenderOptions& options, const Opened& opened,
                          RenderShaders& shaders, Diagnostics& diagnostics) {
  assignments_ = assign_materials(*opened.document, world_, options.assignment, diagnostics);
  if (has_own_materials(options)) take_sides(world_, assignments_);
  if (!options.assignment.material.empty() && diagnostics.has_errors()) {
    explain_missing_material(opened, options.assignment.material, options.common.shader_options(),
                             diagnostics);
  }
  if (diagnostics.has_errors()) return false;
  auto found = shaders.of(world_, assignments_, settings_.frame, diagnostics);
  if (!found) return false;
  shaders_ = *std::move(found);
  return true;
}

/// What shades each mesh, and warnings of what those lack.
void RenderMoment::bind(const std::string& scene_file, Diagnostics& diagnostics) {
  input_.solids = shaders_.solids;
  std::vector<ShadedMesh> shaded;
  for (std::size_t i = 0; i < assignments_.size(); ++i) {
    const MeshAssignment& each = assignments_[i];
    host::Mesh& mesh = world_.meshes[i];
    mesh.visible_to = each.visible_to;
    mesh.two_sided = each.two_sided;
    mesh.matte = each.matte;
    mesh.illuminated = each.illuminated;
    mesh.priority = each.priority;
    const TwoShaders* both = shaders_.by_mesh[i];
    input_.shaders.push_back(both == nullptr ? shaders_.neutral : both->front.get());
    input_.back_shaders.push_back(both == nullptr ? nullptr : both->back.get());
    input_.material_names.push_back(both == nullptr ? mesh.material_name : each.material);
    if (both == nullptr) continue;
    for (const KernelShader* shader : both->all()) {
      shaded.push_back({&mesh, shader, each.material});
    }
  }
  report_missing_attributes(shaded, scene_file, diagnostics);
}

/// What is asked for of passes, now that there are shaders and lights. False after an error.
bool RenderMoment::complete_passes(const PassOptions& options, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  complete_values(settings_.passes, diagnostics);
  std::vector<std::string> names;
  for (const KernelLight* light : shaders_.lights) {
    names.push_back(light->kernel().outputs.front().name);
  }
  for (const host::PunctualLight& light : world_.lights) names.push_back(light.name);
  complete_groups(options, world_, names, settings_.passes, diagnostics);
  return diagnostics.error_count() == errors;
}

bool RenderMoment::displaces() const {
  return std::ranges::any_of(input_.shaders, [](const host::Shader* shader) {
    return shader != nullptr && shader->capabilities().displaces;
  });
}

const host::Bvh* RenderMoment::bvh(Diagnostics& diagnostics) {
  if (!bvh_) bvh_.emplace(world_, diagnostics);
  return bvh_->ok() ? &*bvh_ : nullptr;
}

}  // namespace nacre::tool
