#include "examples/render/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "examples/common/image_writer.h"
#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/displace.h"
#include "examples/render/image_io.h"
#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/nested_solids.h"
#include "examples/tool/assignment.h"
#include "examples/tool/crop_option.h"
#include "examples/tool/kernel_light.h"
#include "examples/tool/kernel_shader.h"
#include "examples/tool/missing_attributes.h"
#include "examples/tool/missing_material.h"
#include "examples/tool/neutral.h"
#include "examples/tool/not_rendered.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/render_answer.h"
#include "examples/tool/render_checkpoint.h"
#include "examples/tool/render_options.h"
#include "examples/tool/render_report.h"
#include "examples/tool/scene_materials.h"
#include "examples/tool/size.h"
#include "examples/tool/stop.h"
#include "examples/tool/technique_options.h"
#include "examples/tool/varying_slots.h"
#include "jit/document/inheritance.h"
#include "jit/document/select.h"

namespace nacre::tool {

namespace {

constexpr float radians = 0.01745329252f;

std::optional<host::Environment> environment(const RenderOptions& options,
                                             Diagnostics& diagnostics) {
  const float rotation = options.environment_rotation * radians;
  if (options.environment.empty()) {
    return host::Environment::studio(options.environment_scale, rotation);
  }
  return host::Environment::load(options.environment, options.environment_scale, rotation,
                                 options.common.texture_limits.limits, diagnostics);
}

/// The scene with a camera that sees it, whatever floor is put below.
host::Scene scene(const RenderOptions& options, Diagnostics& diagnostics) {
  if (options.scene.empty()) return host::make_builtin_scene();
  const host::RenderSettings& s = options.settings;
  const double time = static_cast<double>(s.time);
  const host::Shutter shutter{time + static_cast<double>(s.shutter_open),
                              time + static_cast<double>(s.shutter_close)};
  host::Scene loaded = host::load_scene(options.scene, options.scene_limits, diagnostics, shutter,
                                        {has_own_materials(options), options.variant});
  if (loaded.meshes.empty()) return loaded;
  if (!loaded.camera) {
    const float aspect =
        static_cast<float>(options.settings.width) / static_cast<float>(options.settings.height);
    loaded.camera = host::fit_camera(host::bounds(loaded), aspect);
  }
  if (options.ground) loaded.meshes.push_back(host::make_ground_below(loaded));
  return loaded;
}

host::Camera camera(const RenderOptions& options, const host::Scene& scene) {
  host::Camera result = scene.camera.value_or(host::Camera{});
  result.lens_radius = options.lens_radius;
  if (options.focus_distance > 0.0f) result.focus_distance = options.focus_distance;
  return result;
}

struct TwoShaders {
  std::unique_ptr<KernelShader> front;
  std::unique_ptr<KernelShader> back;  ///< Null: as the front.

  /// Those that are there.
  std::vector<const KernelShader*> all() const {
    if (back == nullptr) return {front.get()};
    return {front.get(), back.get()};
  }
};

/// By MeshAssignment::key.
using Shaders = std::map<std::string, TwoShaders>;

/// Whether what enters any of them by one side leaves by another.
bool are_solids(const std::vector<const host::Mesh*>& meshes) {
  return std::ranges::all_of(meshes, [](const host::Mesh* mesh) { return host::is_closed(*mesh); });
}

/// Those that are not there yet. `is_nested`: they ask what is around. Completes the values that
/// passes want.
bool compile_shaders(RenderOptions& options, const Opened& opened, const host::Scene& world,
                     const std::vector<MeshAssignment>& assignments, bool is_nested,
                     RenderStop& stop, Shaders& shaders, Diagnostics& diagnostics) {
  std::map<std::string, std::vector<const host::Mesh*>> meshes;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    meshes[assignments[i].key()].push_back(&world.meshes[i]);
  }
  NotRendered not_rendered(opened, diagnostics);
  for (const MeshAssignment& assignment : assignments) {
    if (assignment.material.empty() || shaders.contains(assignment.key())) continue;
    ShaderOptions shader = with_profile(opened, assignment.material, true,
                                        options.common.shader_options(), diagnostics);
    shader.graph.frame = static_cast<int>(std::floor(options.settings.frame));
    shader.graph.variants = assignment.variants;
    shader.graph.geometry_tokens = assignment.tokens;
    shader.kernels.entries |= entry_interior;
    if (options.walks) shader.kernels.entries |= entry_subsurface;
    shader.kernels.energy_conserving = options.energy_conserving;
    ask_for_passes(options.settings.passes, shader.kernels);
    shader.varying = varying_slots(meshes.at(assignment.key()), host::is_open(options.settings));
    if (is_nested) shader.varying.emplace_back("exterior_index");
    ask_for_techniques(options.settings.techniques, shader);
    const auto compile = [&](Diagnostics& to) {
      return opened.system->compile_material(*opened.document, assignment.material, shader, to);
    };
    auto kernels = compile(diagnostics);
    if (kernels != nullptr && kernels->subsurface && !are_solids(meshes.at(assignment.key()))) {
      shader.kernels.entries &= ~entry_subsurface;
      Diagnostics said;  // Already.
      kernels = compile(said);
      if (kernels == nullptr) {
        for (const Diagnostic& each : said.all()) diagnostics.add(each);
      }
    }
    if (kernels == nullptr) return false;
    if (!kernels->has_surface && kernels->light && has_place(kernels->light->program())) {
      diagnostics.error("light-has-place", {},
                        "material '" + assignment.material +
                            "' is a light that stands somewhere by itself, and no mesh's",
                        "a <light>, which is where its mesh is");
      return false;
    }
    if (!kernels->has_surface && !kernels->has_light && !kernels->volume) {
      diagnostics.error(
          "no-surface", {},
          "material '" + assignment.material + "' has no surface, and nothing else is rendered",
          "a surface, a volume or a light shader");
      return false;
    }
    not_rendered.look_at_material(assignment.material, *kernels);
    look_for_values(*kernels, options.settings.passes, diagnostics);
    TwoShaders& place = shaders[assignment.key()];
    const std::string& material = assignment.material;
    if (kernels->displacement) {
      not_rendered.look_at_displaced(material, meshes.at(assignment.key()), options.dice > 0.0f);
    }
    const bool is_volume = !kernels->has_surface && kernels->volume;
    if (has_medium(*kernels) || is_volume)
      not_rendered.look_at_solids(material, meshes.at(assignment.key()));
    const bool has_back = kernels->has_back;
    const std::vector<host::GraphValue>& values = options.settings.passes.values;
    place.front = std::make_unique<KernelShader>(std::move(kernels), stop, is_nested, values);
    if (!has_back) continue;
    shader.side = Side::back;
    kernels = compile(diagnostics);
    if (kernels == nullptr) return false;
    place.back = std::make_unique<KernelShader>(std::move(kernels), stop, is_nested, values);
  }
  return true;
}

/// Compiles once more what may be in something else that bends light, where there is such.
bool nest_shaders(RenderOptions& options, const Opened& opened, const host::Scene& world,
                  const std::vector<MeshAssignment>& assignments, RenderStop& stop,
                  Shaders& shaders, std::vector<bool>& solids, Diagnostics& diagnostics) {
  const auto lets_in = [&](std::uint32_t mesh) {
    const MeshAssignment& each = assignments[mesh];
    return !each.material.empty() && shaders.at(each.key()).front->lets_in();
  };
  const host::NestedSolids nested = host::find_nested_solids(world, lets_in);
  solids = nested.solid;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (nested.solid[i] || nested.within[i]) shaders.erase(assignments[i].key());
  }
  Diagnostics said;  // Already.
  const bool done = compile_shaders(options, opened, world, assignments, true, stop, shaders, said);
  for (const Diagnostic& each : done ? std::span<const Diagnostic>() : said.all())
    diagnostics.add(each);
  return done;
}

bool is_of_material(const Opened& opened, const Element& light) {
  return std::ranges::any_of(opened.document->root().children(), [&](const Element& material) {
    const Element* input =
        material.category() == "lightmaterial" ? find_input(material, "lightshader") : nullptr;
    return input != nullptr && input->attribute("nodename") == light.name();
  });
}

/// Light shaders of the document that stand somewhere by themselves: those that have a direction.
bool compile_lights(const RenderOptions& options, const Opened& opened, RenderStop& stop,
                    std::vector<std::unique_ptr<KernelLight>>& lights, Diagnostics& diagnostics) {
  for (const Element& element : opened.document->root().children()) {
    if (!is_node(element) || element.attribute("type") != "lightshader") continue;
    ShaderOptions shader = options.common.shader_options();
    shader.graph.frame = static_cast<int>(std::floor(options.settings.frame));
    if (host::is_open(options.settings)) shader.varying = {"time", "frame"};
    auto kernel = opened.system->compile_outputs(*opened.document, {std::string(element.name())},
                                                 shader, diagnostics);
    if (kernel == nullptr) return false;
    if (!has_place(kernel->kernel.program())) {
      if (!is_of_material(opened, element)) {
        diagnostics.warning("light-without-place", location(element),
                            "the light is nowhere and not rendered",
                            "a <lightmaterial> that is assigned to a mesh");
      }
      continue;
    }
    auto light = KernelLight::create(std::move(kernel), stop, diagnostics);
    if (light == nullptr) return false;
    lights.push_back(std::move(light));
  }
  return true;
}

/// Says of which materials and lights a kernel took too many steps.
void report_failed(const Opened& opened, const std::vector<MeshAssignment>& assignments,
                   const Shaders& shaders, const std::vector<std::unique_ptr<KernelLight>>& lights,
                   Diagnostics& diagnostics) {
  for (const auto& light : lights) {
    const OutputKernel::Output& output = light->kernel().outputs.front();
    if (!light->has_failed()) continue;
    diagnostics.error("too-many-steps", output.where,
                      "light '" + output.name +
                          "' takes too many steps for a point, or a loop of it does not end");
  }
  std::set<std::string> said;
  for (const MeshAssignment& assignment : assignments) {
    const auto found = shaders.find(assignment.key());
    if (found == shaders.end() || !said.insert(assignment.material).second) continue;
    if (std::ranges::none_of(found->second.all(), &KernelShader::has_failed)) continue;
    const Element* material = opened.document->root().child(assignment.material);
    diagnostics.error("too-many-steps",
                      material != nullptr ? location(*material) : SourceLocation{},
                      "material '" + assignment.material +
                          "' takes too many steps for a point, or a loop of it does not end");
  }
}

/// What a render calls.
std::vector<const BoundKernel*> kernels_of(
    const Shaders& shaders, const KernelShader& neutral,
    const std::vector<std::unique_ptr<KernelLight>>& lights) {
  std::vector<const BoundKernel*> kernels = neutral.kernels();
  for (const auto& light : lights) kernels.push_back(&light->kernel().kernel);
  for (const auto& [key, both] : shaders) {
    for (const KernelShader* shader : both.all()) {
      const std::vector<const BoundKernel*> more = shader->kernels();
      kernels.insert(kernels.end(), more.begin(), more.end());
    }
  }
  return kernels;
}

/// What shades each mesh, and warnings of what those lack.
void bind_shaders(const std::vector<MeshAssignment>& assignments, const Shaders& shaders,
                  const KernelShader& neutral, const std::string& scene_file, host::Scene& world,
                  host::RenderInput& input, Diagnostics& diagnostics) {
  std::vector<ShadedMesh> shaded;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const MeshAssignment& each = assignments[i];
    host::Mesh& mesh = world.meshes[i];
    mesh.visible_to = each.visible_to;
    mesh.two_sided = each.two_sided;
    mesh.matte = each.matte;
    mesh.illuminated = each.illuminated;
    mesh.priority = each.priority;
    const TwoShaders* both = each.material.empty() ? nullptr : &shaders.at(each.key());
    input.shaders.push_back(both == nullptr ? &neutral : both->front.get());
    input.back_shaders.push_back(both == nullptr ? nullptr : both->back.get());
    input.material_names.push_back(both == nullptr ? mesh.material_name : each.material);
    if (both == nullptr) continue;
    for (const KernelShader* shader : both->all()) {
      shaded.push_back({&mesh, shader, each.material});
    }
  }
  report_missing_attributes(shaded, scene_file, diagnostics);
}

/// Moves the surfaces that are displaced.
void displace(const RenderOptions& options, host::Scene& world, const host::RenderInput& input,
              Diagnostics& diagnostics) {
  const host::RenderSettings& s = options.settings;
  const host::PixelCamera camera(input.camera, s.width, s.height, 1.0f, input.camera_motion);
  // By what a triangle takes with its share of vertices, and what rays are traced against.
  constexpr std::size_t bytes_of_triangle = 200;
  const host::DisplaceResult result =
      host::displace(world, input.shaders, camera, input.camera.position,
                     {.edge = options.dice,
                      .most_triangles = options.scene_limits.bytes / bytes_of_triangle,
                      .clock = {s.time, s.frame, s.shutter_open, s.shutter_close, s.fps},
                      .stop = tool::stop().token()});
  for (const std::uint32_t mesh : result.coarse) {
    diagnostics.warning("coarse-displacement", {},
                        "'" + world.meshes[mesh].object_name +
                            "' is displaced in triangles that are larger than asked for",
                        "a larger --max-scene-size, or a larger --dice");
  }
  for (const std::uint32_t mesh : result.stopped) {
    diagnostics.warning("displaced-stands", {},
                        "'" + world.meshes[mesh].object_name +
                            "' is displaced, and does not bend while the shutter is open");
  }
  if (result.invalid == 0) return;
  diagnostics.warning("invalid-displacement", {},
                      "some vertices are displaced to where nothing can be, and stay", "numbers",
                      fmt::format("{} that are not", result.invalid));
}

/// Whether the image that is to be written holds them.
void check_passes(const RenderOptions& options, Diagnostics& diagnostics) {
  const host::PassRequest& passes = options.settings.passes;
  if (options.passes.any() && !options.out.ends_with(".exr")) {
    diagnostics.error("passes-need-exr", {}, "passes are layers of an .exr", "--out FILE.exr",
                      "'" + options.out + "'");
  }
  if (options.write.half && (passes.object_mattes || passes.material_mattes)) {
    diagnostics.error("mattes-need-floats", {}, "names of mattes are floats of 32 bits",
                      "no --half");
  }
}

/// Completes what is asked for of passes, once there are shaders and lights.
void complete_passes(RenderOptions& options, const host::Scene& world,
                     const std::vector<std::unique_ptr<KernelLight>>& lights,
                     Diagnostics& diagnostics) {
  host::PassRequest& passes = options.settings.passes;
  complete_values(passes, diagnostics);
  std::vector<std::string> names;
  for (const auto& light : lights) names.push_back(light->kernel().outputs.front().name);
  for (const host::PunctualLight& light : world.lights) names.push_back(light.name);
  complete_groups(options.passes, world, names, passes, diagnostics);
}

int run(RenderOptions& options, nlohmann::ordered_json& answer) {
  Diagnostics diagnostics;
  if (!parse_size(options.size, options.settings.width, options.settings.height, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  options.settings.threads = options.common.threads;
  options.settings.passes = pass_request(options.passes, diagnostics);
  check_passes(options, diagnostics);
  check_techniques(options.settings, diagnostics);
  check_crop(options.settings, diagnostics);
  if (diagnostics.has_errors() || !check_request(options, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  const bool has_own = has_own_materials(options);
  promise_files({options.out, options.document});
  Opened opened;
  if (!has_own) opened = open(options.common, diagnostics);
  if (!has_own && !opened) return report(diagnostics);
  if (!options.out.empty() && (!host::is_image_name(options.out, diagnostics) ||
                               !host::prepare_image(options.out, diagnostics))) {
    return report(diagnostics);
  }
  host::Scene world = scene(options, diagnostics);
  if (has_own && !diagnostics.has_errors()) {
    opened = open_scene_materials(options, world, diagnostics);
    if (!opened || options.out.empty()) return report(diagnostics);
  }
  const auto sky = environment(options, diagnostics);
  if (diagnostics.has_errors() || !sky) return report(diagnostics);
  host::RenderInput input;
  input.scene = &world;
  input.environment = &*sky;
  input.camera = camera(options, world);
  input.camera_motion = world.camera_motion;
  if (!host::check_camera(input.camera, diagnostics)) return report(diagnostics);

  std::vector<MeshAssignment> assignments =
      assign_materials(*opened.document, world, options.assignment, diagnostics);
  if (has_own) take_sides(world, assignments);
  if (!options.assignment.material.empty() && diagnostics.has_errors()) {
    explain_missing_material(opened, options.assignment.material, options.common.shader_options(),
                             diagnostics);
  }
  RenderStop stop;
  Shaders shaders;
  if (diagnostics.has_errors() ||
      !compile_shaders(options, opened, world, assignments, false, stop, shaders, diagnostics) ||
      !nest_shaders(options, opened, world, assignments, stop, shaders, input.solids,
                    diagnostics)) {
    return report(diagnostics);
  }
  std::vector<std::unique_ptr<KernelLight>> lights;
  if (!compile_lights(options, opened, stop, lights, diagnostics)) return report(diagnostics);
  for (const auto& light : lights) input.lights.push_back(light.get());
  const std::vector<host::PunctualShader> scene_lights(world.lights.begin(), world.lights.end());
  for (const host::PunctualShader& light : scene_lights) input.lights.push_back(&light);
  const std::size_t errors = diagnostics.error_count();
  complete_passes(options, world, lights, diagnostics);
  if (diagnostics.error_count() != errors) return report(diagnostics);
  ShaderOptions neutral_options = options.common.shader_options();
  neutral_options.kernels.by_lobe = options.settings.passes.any(host::PassNeed::split);
  ask_for_techniques(options.settings.techniques, neutral_options);
  auto grey = neutral_material(*opened.system, neutral_options, diagnostics);
  if (grey == nullptr) return report(diagnostics);
  const KernelShader neutral(std::move(grey), stop);
  bind_shaders(assignments, shaders, neutral, options.scene, world, input, diagnostics);
  if (options.dice > 0.0f) displace(options, world, input, diagnostics);
  const std::vector<const BoundKernel*> kernels = kernels_of(shaders, neutral, lights);

  take_time_to_stop(5.0);
  const Enough enough(options.progress.time_limit);
  std::optional<host::Checkpoint> checkpoint;
  if (!options.progress.checkpoint.empty()) {
    const auto key = render_key(options, opened, world, kernels, diagnostics);
    if (!key) return report(diagnostics);
    checkpoint.emplace(options.progress.checkpoint, *key, options.progress.checkpoint_every);
  }
  ProgressLine line("render", options.common.quiet);
  const auto pending = [&] {
    return static_cast<int>(
        std::ranges::count_if(kernels, [](const BoundKernel* each) { return each->is_pending(); }));
  };
  const host::RenderControl control{.stop = stop.token(),
                                    .enough = enough.token(),
                                    .progress = [&](double share) { line.update(share); },
                                    .pending = pending,
                                    .checkpoint = checkpoint ? &*checkpoint : nullptr};
  host::RenderStatistics statistics;
  const auto film = host::render(input, options.settings, diagnostics, control, &statistics);
  report_left_out(statistics, diagnostics);
  report_failed(opened, assignments, shaders, lights, diagnostics);
  for (const BoundKernel* kernel : kernels) {
    report_code(*kernel, options.common.shader_options(), diagnostics);
  }
  if (film && options.settings.noise > 0 && !options.common.quiet) {
    fmt::print(stderr, "{}\n", samples_text(statistics, options.settings));
  }
  if (film) report_samples(statistics, options.settings, enough, diagnostics);
  if (film && host::write_image(*film, options.out, options.write, diagnostics)) {
    if (!statistics.is_whole && !enough.is_out_of_time()) {
      keep_promise_partly(options.out, samples_text(statistics, options.settings));
    }
    file_is_written(options.out, options.common.quiet || options.json);
    report_crop(options.settings, options.out, diagnostics);
    answer = written_picture(options, statistics);
  }
  report_texels(*opened.system, diagnostics);
  const int status = report(diagnostics);
  return film ? status : status_problems;
}

}  // namespace

void add_render(CLI::App& app, int& status) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command =
      *app.add_subcommand("render", "Path trace a scene with the document's materials");
  add_render_options(command, *options);
  command.callback([options, &status, &command] {
    options->asked = asked_of(command);
    const std::string& named = options->common.file;
    nlohmann::ordered_json answer = unwritten_picture(*options);
    status = guarded(named.empty() ? options->scene : named, [&] { return run(*options, answer); });
    if (options->json && status != status_usage) print_json(answer);
  });
}

}  // namespace nacre::tool
