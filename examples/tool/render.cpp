#include "examples/render/render.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/image_io.h"
#include "examples/render/load_scene.h"
#include "examples/tool/assignment.h"
#include "examples/tool/kernel_shader.h"
#include "examples/tool/neutral.h"
#include "examples/tool/options.h"
#include "examples/tool/size.h"
#include "examples/tool/stop.h"

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
  host::Scene loaded = host::load_scene(options.scene, diagnostics);
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
};

/// By MeshAssignment::key.
using Shaders = std::map<std::string, TwoShaders>;

bool compile_shaders(const RenderOptions& options, const Opened& opened,
                     const std::vector<MeshAssignment>& assignments, Shaders& shaders,
                     Diagnostics& diagnostics) {
  for (const MeshAssignment& assignment : assignments) {
    if (assignment.material.empty() || shaders.contains(assignment.key())) continue;
    ShaderOptions shader = options.common.shader_options();
    shader.graph.frame = static_cast<int>(std::floor(options.settings.frame));
    shader.graph.variants = assignment.variants;
    shader.graph.geometry_tokens = assignment.tokens;
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
    TwoShaders& place = shaders[assignment.key()];
    const bool has_back = kernels->has_back;
    place.front = std::make_unique<KernelShader>(std::move(kernels));
    if (!has_back) continue;
    shader.side = Side::back;
    kernels =
        opened.system->compile_material(*opened.document, assignment.material, shader, diagnostics);
    if (kernels == nullptr) return false;
    place.back = std::make_unique<KernelShader>(std::move(kernels));
  }
  return true;
}

void print_summary(const RenderOptions& options, const host::RenderStatistics& statistics) {
  if (options.common.quiet) return;
  if (statistics.invalid_results != 0) {
    fmt::print(stderr, "{} results were not finite and were dropped\n", statistics.invalid_results);
  }
  fmt::print("{}\n", options.out);
}

int run(RenderOptions& options) {
  Diagnostics diagnostics;
  if (!parse_size(options.size, options.settings.width, options.settings.height, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  options.settings.threads = options.common.threads;
  const Opened opened = open(options.common, diagnostics);
  if (!opened) return report(diagnostics);
  host::Scene world = scene(options, diagnostics);
  const auto sky = environment(options, diagnostics);
  if (diagnostics.has_errors() || !sky) return report(diagnostics);

  const std::vector<MeshAssignment> assignments =
      assign_materials(*opened.document, world, options.assignment, diagnostics);
  Shaders shaders;
  if (diagnostics.has_errors() ||
      !compile_shaders(options, opened, assignments, shaders, diagnostics)) {
    return report(diagnostics);
  }
  host::RenderInput input;
  input.scene = &world;
  input.environment = &*sky;
  input.camera = camera(options, world);
  auto grey = neutral_material(*opened.system, options.common.shader_options(), diagnostics);
  if (grey == nullptr) return report(diagnostics);
  const KernelShader neutral(std::move(grey));
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
  }

  const StopOnSignal stop;
  ProgressLine line("render", options.common.quiet);
  const host::RenderControl control{.stop = stop.token(),
                                    .progress = [&](double share) { line.update(share); }};
  host::RenderStatistics statistics;
  const auto film = host::render(input, options.settings, diagnostics, control, &statistics);
  if (film && host::write_image(*film, options.out, options.write, diagnostics)) {
    print_summary(options, statistics);
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
  options->common.add_document(command);
  options->assignment.add(command);
  host::RenderSettings& settings = options->settings;
  command.add_option("--scene", options->scene, "glTF 2.0 or OBJ (default: a built-in one)")
      ->type_name("FILE");
  command.add_flag("--ground", options->ground, "Put a neutral floor below the scene");
  command.add_option("--spp", settings.samples, "Samples a pixel")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--size", options->size, "Pixels: N or WxH")->capture_default_str();
  command.add_option("--out", options->out, "Image to write: .exr or .png")
      ->required()
      ->type_name("FILE");
  command.add_option("--max-depth", settings.max_depth, "Scattering events on a path")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "Of the random numbers")->capture_default_str();
  command.add_option("--frame", settings.frame, "Frame number")->capture_default_str();
  command.add_option("--time", settings.time, "Seconds")->capture_default_str();
  command
      .add_option("--environment", options->environment,
                  "Latitude-longitude image (default: a built-in studio)")
      ->type_name("FILE");
  command.add_option("--environment-scale", options->environment_scale)->capture_default_str();
  command.add_option("--environment-rotation", options->environment_rotation, "Degrees about +y")
      ->capture_default_str();
  command.add_option("--exposure", options->write.exposure, "Stops; png only")
      ->capture_default_str();
  command
      .add_option("--white", options->write.white, "Luminance shown as white; 0: clip; png only")
      ->capture_default_str();
  command.add_flag("--half", options->write.half, "16-bit floats in .exr");
  command.add_option("--lens-radius", options->lens_radius, "Scene units; 0: all in focus")
      ->capture_default_str();
  command.add_option("--focus-distance", options->focus_distance,
                     "Scene units (default: the middle)");
  options->common.add_compile(command);
  command.callback([options, &status] { status = run(*options); });
}

}  // namespace nacre::tool
