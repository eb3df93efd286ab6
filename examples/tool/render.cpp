#include "examples/render/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "examples/common/atomic_file.h"
#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/image_io.h"
#include "examples/render/load_scene.h"
#include "examples/tool/assignment.h"
#include "examples/tool/kernel_shader.h"
#include "examples/tool/missing_attributes.h"
#include "examples/tool/missing_material.h"
#include "examples/tool/neutral.h"
#include "examples/tool/not_rendered.h"
#include "examples/tool/number_range.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/size.h"
#include "examples/tool/stop.h"
#include "examples/tool/varying_slots.h"

namespace nacre::tool {

namespace {

struct RenderOptions {
  CommonOptions common;
  AssignmentOptions assignment;
  std::string scene;
  std::string out;
  std::string size = "512";
  std::string environment;
  float environment_scale = 1.0f;
  float environment_rotation = 0.0f;  ///< Degrees.
  host::SceneLimits scene_limits;
  host::RenderSettings settings;
  host::WriteOptions write;
  float lens_radius = 0.0f;
  float focus_distance = 0.0f;
  bool ground = false;
};

constexpr float radians = 0.01745329252f;

std::optional<host::Environment> environment(const RenderOptions& options,
                                             Diagnostics& diagnostics) {
  if (options.environment.empty()) return host::Environment::studio();
  return host::Environment::load(options.environment, options.environment_scale,
                                 options.environment_rotation * radians,
                                 options.common.texture_limits.limits, diagnostics);
}

/// The scene with a camera that sees it, whatever floor is put below.
host::Scene scene(const RenderOptions& options, Diagnostics& diagnostics) {
  if (options.scene.empty()) return host::make_builtin_scene();
  host::Scene loaded = host::load_scene(options.scene, options.scene_limits, diagnostics);
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

bool compile_shaders(const RenderOptions& options, const Opened& opened, const host::Scene& world,
                     const std::vector<MeshAssignment>& assignments, RenderStop& stop,
                     Shaders& shaders, Diagnostics& diagnostics) {
  std::map<std::string, std::vector<const host::Mesh*>> meshes;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    meshes[assignments[i].key()].push_back(&world.meshes[i]);
  }
  NotRendered not_rendered(opened, diagnostics);
  not_rendered.look_at_document();
  for (const MeshAssignment& assignment : assignments) {
    if (assignment.material.empty() || shaders.contains(assignment.key())) continue;
    ShaderOptions shader = options.common.shader_options();
    shader.graph.frame = static_cast<int>(std::floor(options.settings.frame));
    shader.graph.variants = assignment.variants;
    shader.graph.geometry_tokens = assignment.tokens;
    shader.varying = varying_slots(meshes.at(assignment.key()));
    auto kernels =
        opened.system->compile_material(*opened.document, assignment.material, shader, diagnostics);
    if (kernels == nullptr) return false;
    if (!kernels->has_surface) {
      diagnostics.error(
          "no-surface", {},
          "material '" + assignment.material + "' has no surface, and nothing else is rendered",
          "a surface shader");
      return false;
    }
    not_rendered.look_at_material(assignment.material, *kernels);
    TwoShaders& place = shaders[assignment.key()];
    const bool has_back = kernels->has_back;
    place.front = std::make_unique<KernelShader>(std::move(kernels), stop);
    if (!has_back) continue;
    shader.side = Side::back;
    kernels =
        opened.system->compile_material(*opened.document, assignment.material, shader, diagnostics);
    if (kernels == nullptr) return false;
    place.back = std::make_unique<KernelShader>(std::move(kernels), stop);
  }
  return true;
}

/// Says of which materials a kernel took too many steps.
void report_failed(const Opened& opened, const std::vector<MeshAssignment>& assignments,
                   const Shaders& shaders, Diagnostics& diagnostics) {
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
std::vector<const BoundKernel*> kernels_of(const Shaders& shaders, const KernelShader& neutral) {
  std::vector<const BoundKernel*> kernels = neutral.kernels();
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
    const TwoShaders* both = each.material.empty() ? nullptr : &shaders.at(each.key());
    input.shaders.push_back(both == nullptr ? &neutral : both->front.get());
    input.back_shaders.push_back(both == nullptr ? nullptr : both->back.get());
    if (both == nullptr) continue;
    for (const KernelShader* shader : both->all()) {
      shaded.push_back({&mesh, shader, each.material});
    }
  }
  report_missing_attributes(shaded, scene_file, diagnostics);
}

void report_invalid_results(const host::RenderStatistics& statistics, Diagnostics& diagnostics) {
  if (statistics.invalid_results == 0) return;
  diagnostics.warning("invalid-results", {},
                      "some results of kernels were not finite and were left out", "finite numbers",
                      fmt::format("{} that were not", statistics.invalid_results));
}

int run(RenderOptions& options) {
  Diagnostics diagnostics;
  if (!parse_size(options.size, options.settings.width, options.settings.height, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  options.settings.threads = options.common.threads;
  promise_files({options.out});
  const Opened opened = open(options.common, diagnostics);
  if (!opened) return report(diagnostics);
  if (!host::is_image_name(options.out, diagnostics) ||
      !host::prepare_output(options.out, diagnostics)) {
    return report(diagnostics);
  }
  host::Scene world = scene(options, diagnostics);
  const auto sky = environment(options, diagnostics);
  if (diagnostics.has_errors() || !sky) return report(diagnostics);
  host::RenderInput input;
  input.scene = &world;
  input.environment = &*sky;
  input.camera = camera(options, world);
  if (!host::check_camera(input.camera, diagnostics)) return report(diagnostics);

  const std::vector<MeshAssignment> assignments =
      assign_materials(*opened.document, world, options.assignment, diagnostics);
  if (!options.assignment.material.empty() && diagnostics.has_errors()) {
    explain_missing_material(opened, options.assignment.material, options.common.shader_options(),
                             diagnostics);
  }
  RenderStop stop;
  Shaders shaders;
  if (diagnostics.has_errors() ||
      !compile_shaders(options, opened, world, assignments, stop, shaders, diagnostics)) {
    return report(diagnostics);
  }
  auto grey = neutral_material(*opened.system, options.common.shader_options(), diagnostics);
  if (grey == nullptr) return report(diagnostics);
  const KernelShader neutral(std::move(grey), stop);
  bind_shaders(assignments, shaders, neutral, options.scene, world, input, diagnostics);
  const std::vector<const BoundKernel*> kernels = kernels_of(shaders, neutral);

  stop.follow(tool::stop().token());
  ProgressLine line("render", options.common.quiet);
  const auto pending = [&] {
    return static_cast<int>(
        std::ranges::count_if(kernels, [](const BoundKernel* each) { return each->is_pending(); }));
  };
  const host::RenderControl control{.stop = stop.token(),
                                    .progress = [&](double share) { line.update(share); },
                                    .pending = pending};
  host::RenderStatistics statistics;
  const auto film = host::render(input, options.settings, diagnostics, control, &statistics);
  report_invalid_results(statistics, diagnostics);
  report_failed(opened, assignments, shaders, diagnostics);
  for (const BoundKernel* kernel : kernels) {
    report_code(*kernel, options.common.shader_options(), diagnostics);
  }
  if (film && host::write_image(*film, options.out, options.write, diagnostics)) {
    file_is_written(options.out, options.common.quiet);
  }
  report_texels(*opened.system, diagnostics);
  const int status = report(diagnostics);
  return film ? status : status_problems;
}

}  // namespace

namespace {

void add_scene_limits(CLI::App& command, host::SceneLimits& limits) {
  const auto add = [&](const char* flag, auto& value, const char* what) {
    return command.add_option(flag, value, what)
        ->capture_default_str()
        ->group("Limits, beyond which a scene is refused (sizes: 64MB, 2GB)");
  };
  const auto size = CLI::AsSizeValue(false);
  add("--max-scene-file-size", limits.file_bytes, "Bytes of the scene's files together")
      ->transform(size)
      ->type_name("SIZE");
  add("--max-scene-size", limits.bytes, "Bytes of its geometry in memory, with all instances")
      ->transform(size)
      ->type_name("SIZE");
  add("--max-meshes", limits.meshes, "Meshes with all instances")
      ->check(number_within(0, 1e9))
      ->type_name("N");
  add("--max-scene-values", limits.values, "Values of the JSON of a glTF file")
      ->check(number_within(0, 1e9))
      ->type_name("N");
  add("--max-node-depth", limits.node_depth, "Nodes within nodes")
      ->check(number_within(1, 10'000))
      ->type_name("N");
}

}  // namespace

void add_render(CLI::App& app, int& status) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command =
      *app.add_subcommand("render", "Path trace a scene with the document's materials");
  options->common.add_document(command);
  options->assignment.add(command);
  host::RenderSettings& settings = options->settings;
  command.add_option("--scene", options->scene, "glTF 2.0 or OBJ (default: a built-in one)")
      ->type_name("FILE");
  command.add_flag("--ground", options->ground, "Put a neutral floor below the scene");
  command.add_option("--spp", settings.samples, "Samples a pixel")
      ->check(number_within(1, 1e9))
      ->capture_default_str();
  command.add_option("--size", options->size, "Pixels: N or WxH")->capture_default_str();
  command.add_option("--out", options->out, "Image to write: .exr or .png")
      ->required()
      ->type_name("FILE");
  command.add_option("--max-depth", settings.max_depth, "Scattering events on a path")
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "Of the random numbers")->capture_default_str();
  command.add_option("--frame", settings.frame, "Frame number")
      ->check(number_within(-1e9, 1e9))
      ->capture_default_str();
  command.add_option("--time", settings.time, "Seconds")
      ->check(number_within(-1e9, 1e9))
      ->capture_default_str();
  command
      .add_option("--environment", options->environment,
                  "Latitude-longitude image (default: a built-in studio)")
      ->type_name("FILE");
  command.add_option("--environment-scale", options->environment_scale)
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command.add_option("--environment-rotation", options->environment_rotation, "Degrees about +y")
      ->check(number_within(-1e6, 1e6))
      ->capture_default_str();
  command.add_option("--exposure", options->write.exposure, "Stops; png only")
      ->check(number_within(-100, 100))
      ->capture_default_str();
  command
      .add_option("--white", options->write.white, "Luminance shown as white; 0: clip; png only")
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command.add_flag("--half", options->write.half, "16-bit floats in .exr");
  command.add_option("--lens-radius", options->lens_radius, "Scene units; 0: all in focus")
      ->check(number_within(0, host::largest_coordinate))
      ->capture_default_str();
  command
      .add_option("--focus-distance", options->focus_distance, "Scene units (default: the middle)")
      ->check(number_within(0, host::largest_coordinate));
  add_scene_limits(command, options->scene_limits);
  options->common.add_compile(command);
  options->common.add_waiting(command);
  command.callback([options, &status] {
    status = guarded(options->common.file, [&] { return run(*options); });
  });
}

}  // namespace nacre::tool
