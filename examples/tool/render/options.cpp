#include "examples/tool/render/options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <vector>

#include "examples/tool/number_range.h"
#include "examples/tool/render/crop_option.h"
#include "examples/tool/render/technique_options.h"
#include "examples/tool/scene/limit_options.h"

namespace nacre::tool {

void add_render_options(CLI::App& command, RenderOptions& options) {
  options.common.add_document(command);
  command.get_option("FILE")->required(false)->description(
      "MaterialX document (default: the materials of a glTF scene)");
  options.assignment.add(command);
  host::RenderSettings& settings = options.settings;
  command.add_option("--scene", options.scene, "glTF 2.0, HAIR or OBJ (default: a built-in one)")
      ->type_name("FILE");
  command.add_flag("--energy-conserving", options.energy_conserving,
                   "Let no material send back more light than arrives, whatever its model says");
  command
      .add_option("--dice", options.dice,
                  "Longest edge of the triangles that displacement moves, in pixels; 0 leaves "
                  "surfaces where they are")
      ->check(number_within(0, 1e6))
      ->capture_default_str();
  const std::map<std::string, bool> subsurface{{"diffuse", false}, {"walk", true}};
  command
      .add_option("--subsurface", options.walks,
                  "Light below surfaces: walk follows it through solids, diffuse lets it leave "
                  "where it enters")
      ->transform(CLI::CheckedTransformer(subsurface, CLI::ignore_case)
                      .description("{diffuse,walk}"))  // Not the numbers behind them.
      ->default_str("walk")
      ->type_name("KIND");
  command.add_flag("--ground", options.ground, "Put a neutral floor below the scene");
  command.add_option("--spp", settings.samples, "Samples a pixel")
      ->check(number_within(1, 1e9))
      ->capture_default_str();
  command.add_option("--size", options.size, "Pixels")->capture_default_str()->type_name("N|WxH");
  add_crop(command, settings);
  command.add_option("--out", options.out, "Image to write: .exr or .png")->type_name("FILE");
  command
      .add_option("--write-document", options.document,
                  "Without FILE: the document of the scene's own materials to write, with the "
                  "images that are within the scene file beside it; then --out may be missing")
      ->type_name("FILE.mtlx");
  command
      .add_option("--variant", options.variant,
                  "Which of the scene's variants of materials (KHR_materials_variants)")
      ->type_name("NAME");
  command
      .add_option("--animation", options.animation,
                  "Which of the scene's animations, by name or number from 0 (default: the first)")
      ->type_name("NAME|N");
  command.add_option("--max-depth", settings.max_depth, "Scattering events on a path")
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command
      .add_option("--max-scatterings", settings.max_scatterings,
                  "Scattering events within media, on a path")
      ->check(number_within(0, 1e6))
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "Of the random numbers")->capture_default_str();
  command.add_option("--frame", settings.frame, "Frame number")
      ->check(number_within(-1e9, 1e9))
      ->capture_default_str();
  command.add_option("--time", settings.time, "Seconds")
      ->check(number_within(-1e9, 1e9))
      ->capture_default_str();
  command
      .add_option_function<std::vector<float>>(
          "--shutter",
          [&settings](const std::vector<float>& times) {
            if (times[1] < times[0]) {
              throw CLI::ValidationError("--shutter", "it closes before it opens");
            }
            settings.shutter_open = times[0];
            settings.shutter_close = times[1];
          },
          "Opens and closes so many seconds from --time: what moves between is blurred (default: 0 "
          "0)")
      ->expected(2)
      ->check(number_within(-1e9, 1e9))
      ->type_name("SECONDS");
  command
      .add_option("--fps", settings.fps,
                  "Frames a second: when those of --frames are, and which one a ray's time is in")
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  options.series.add(command);
  command
      .add_option("--environment", options.environment,
                  "Latitude-longitude image (default: a built-in studio)")
      ->type_name("FILE");
  command.add_option("--environment-scale", options.environment_scale)
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command.add_option("--environment-rotation", options.environment_rotation, "Degrees about +y")
      ->check(number_within(-1e6, 1e6))
      ->capture_default_str();
  command.add_option("--exposure", options.write.exposure, "Stops; png only")
      ->check(number_within(-100, 100))
      ->capture_default_str();
  command.add_option("--white", options.write.white, "Luminance shown as white; 0: clip; png only")
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command.add_flag("--json", options.json,
                   "For programs to read: an object that says what was written, with its samples");
  command.add_flag("--half", options.write.half, "16-bit floats in .exr");
  add_techniques(command, settings);
  options.passes.add(command);
  options.denoise.add(command);
  options.view.add(command);
  options.progress.add(command);
  command
      .add_option("--noise", settings.noise,
                  "Enough: the error of a tile relative to its pixels, as its samples tell, at "
                  "which it gets no more; --spp is then the most (default: 0, all samples)")
      ->check(number_within(0, 1e6))
      ->type_name("X");
  command.footer(pass_help());
  CLI::Option* const lens =
      command.add_option("--lens-radius", options.lens_radius, "Scene units; 0: all in focus")
          ->check(number_within(0, host::largest_coordinate))
          ->capture_default_str();
  command
      .add_option("--focus-distance", options.focus_distance, "Scene units (default: the middle)")
      ->check(number_within(0, host::largest_coordinate))
      ->needs(lens);
  add_scene_limits(command, options.scene_limits);
  options.common.add_compile(command);
  options.common.add_lobes(command);
  options.common.add_profile(command);
  command
      .add_option("--record-points", options.points_file,
                  "Write where materials are shaded, some thousand points of each, for nacre tune "
                  "--recorded")
      ->type_name("FILE.json");
  options.common.add_waiting(command);
}

}  // namespace nacre::tool
