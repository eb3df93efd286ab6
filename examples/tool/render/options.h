#pragma once

#include <string>

#include "examples/render/image_io.h"
#include "examples/render/render.h"
#include "examples/render/scene_limits.h"
#include "examples/tool/options.h"
#include "examples/tool/render/denoise_options.h"
#include "examples/tool/render/pass_options.h"
#include "examples/tool/render/progress_options.h"
#include "examples/tool/render/series_options.h"
#include "examples/tool/render/view_options.h"
#include "examples/tool/scene/assignment.h"

namespace nacre::tool {

/// What `nacre render` is asked for.
struct RenderOptions {
  std::string asked;  ///< All that was given and that a picture hangs on, as text.
  CommonOptions common;
  AssignmentOptions assignment;
  std::string scene;
  std::string variant;    ///< SceneLooks::variant
  std::string animation;  ///< SceneLooks::animation
  SeriesOptions series;
  std::string document;  ///< To write: that of the scene's own materials.
  std::string out;
  std::string points_file;  ///< To write: points that were shaded, for `nacre tune`.
  std::string size = "512";
  std::string environment;
  float environment_scale = 1.0f;
  float environment_rotation = 0.0f;  ///< Degrees.
  host::SceneLimits scene_limits;
  host::RenderSettings settings;
  host::WriteOptions write;
  PassOptions passes;
  DenoiseOptions denoise;
  ViewOptions view;
  ProgressOptions progress;
  float lens_radius = 0.0f;
  float focus_distance = 0.0f;
  bool ground = false;
  float dice = 1.0f;               ///< DisplaceSettings::edge; 0: nothing is displaced.
  bool walks = true;               ///< Follow light below surfaces.
  bool energy_conserving = false;  ///< KernelRequest::energy_conserving
  bool json = false;               ///< Say what was made for programs.
};

/// Its options; they write to `options`, which lives as long as `command`.
void add_render_options(CLI::App& command, RenderOptions& options);

}  // namespace nacre::tool
