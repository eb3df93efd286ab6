#include "examples/tool/render/request.h"

#include <algorithm>
#include <string>

#include "examples/tool/render/crop_option.h"
#include "examples/tool/render/technique_options.h"
#include "examples/tool/scene/materials.h"
#include "examples/tool/size.h"
#include "jit/graph/resolve/filename.h"

namespace nacre::tool {

namespace {

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

/// Says of options that change nothing.
void report_idle(const RenderOptions& options, Diagnostics& diagnostics) {
  const RenderOptions defaults;
  const host::RenderSettings& s = options.settings;
  const bool is_exr = options.out.ends_with(".exr"), is_png = options.out.ends_with(".png");
  const auto idle = [&](bool is, const char* option, const char* expected) {
    if (!is) return;
    diagnostics.warning("no-effect", {}, std::string(option) + " changes nothing here", expected);
  };
  idle(is_exr && options.write.exposure != defaults.write.exposure, "--exposure",
       "--out FILE.png: an .exr has light");
  idle(is_exr && options.write.white != defaults.write.white, "--white",
       "--out FILE.png: an .exr has light");
  idle(is_png && options.write.half, "--half", "--out FILE.exr: a .png has whole numbers");
  idle(s.techniques.roulette == host::Roulette::none &&
           s.roulette_depth != defaults.settings.roulette_depth,
       "--roulette-depth", "another --roulette than none");
  const bool has_shutter = s.shutter_open != 0.0f || s.shutter_close != 0.0f;
  idle(s.fps != defaults.settings.fps && !options.series.frames && !has_shutter, "--fps",
       "--frames, or --shutter");
}

}  // namespace

void complete_request(RenderOptions& options, Diagnostics& diagnostics) {
  host::RenderSettings& settings = options.settings;
  if (!parse_size(options.size, settings.width, settings.height, diagnostics)) return;
  settings.threads = options.common.threads;
  settings.passes = pass_request(options.passes, diagnostics);
  ask_for_guides(options.denoise, settings.passes);
  check_passes(options, diagnostics);
  check_view(options.view, options.out, diagnostics);
  check_techniques(settings, diagnostics);
  check_crop(settings, diagnostics);
  report_idle(options, diagnostics);
  check_outputs(outputs_of(options), {options.common.file, options.scene, options.environment},
                diagnostics);
  if (!diagnostics.has_errors()) check_request(options, diagnostics);
}

std::vector<OutputFile> outputs_of(const RenderOptions& options) {
  return {{"--out", options.out},
          {"--write-document", options.document},
          {"--record-points", options.points_file},
          {"--checkpoint", options.progress.checkpoint}};
}

bool check_series(const RenderOptions& options, const std::vector<int>& frames,
                  Diagnostics& diagnostics) {
  const SeriesOptions& series = options.series;
  const std::size_t errors = diagnostics.error_count();
  const bool are_frames = frames.size() > 1;
  const bool are_cameras =
      series.cameras.size() > 1 || std::ranges::find(series.cameras, "all") != series.cameras.end();
  const auto has = [&](const char* token) { return options.out.find(token) != std::string::npos; };
  if (!frames.empty() && !(options.settings.fps > 0.0f)) {
    diagnostics.error("bad-request", {}, "frames have no time", "--fps of more than 0");
  }
  if (options.out.empty()) return diagnostics.error_count() == errors;
  if (are_frames && !has("#") && !has_frame_token(options.out)) {
    diagnostics.error("one-name", {}, "several frames would have one name",
                      "{frame}, {04frame} or #### in --out", "'" + options.out + "'");
  }
  if (are_cameras && !has("{camera}")) {
    diagnostics.error("one-name", {}, "several cameras would have one name", "{camera} in --out",
                      "'" + options.out + "'");
  }
  if ((are_frames || are_cameras) && !options.progress.checkpoint.empty() &&
      !series.skips_existing) {
    diagnostics.error("bad-request", {},
                      "a checkpoint is of one of several pictures, the first that is not there",
                      "--skip-existing beside --checkpoint");
  }
  return diagnostics.error_count() == errors;
}

}  // namespace nacre::tool
