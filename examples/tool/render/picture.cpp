#include "examples/tool/render/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "examples/render/camera.h"
#include "examples/render/displace.h"
#include "examples/render/image_io.h"
#include "examples/tool/output_files.h"
#include "examples/tool/process.h"
#include "examples/tool/render/answer.h"
#include "examples/tool/render/checkpoint.h"
#include "examples/tool/render/crop_option.h"
#include "examples/tool/render/report.h"
#include "examples/tool/render/world.h"
#include "examples/tool/stop.h"

namespace nacre::tool {

namespace {

/// Moves the surfaces of `world` that are displaced, as the picture's camera sees them.
void displace(const RenderOptions& options, const host::RenderSettings& s, host::Scene& world,
              const host::RenderInput& input, Diagnostics& diagnostics) {
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

std::string title(const PictureAtWork& work) {
  if (work.of == 1) return "render";
  return fmt::format("render {} of {}, {}", work.number, work.of,
                     std::filesystem::path(work.picture.file).filename().string());
}

/// Whether a picture is worth a file: one that a signal has cut short would be left out by
/// --skip-existing, as if it was there.
bool is_written(const RenderOptions& options, const host::RenderStatistics& statistics) {
  return statistics.is_whole || !options.series.skips_existing || !stop().is_due();
}

}  // namespace

bool render_picture(const RenderOptions& options, const Opened& opened, RenderMoment& moment,
                    const PictureAtWork& work, RenderStop& stop, nlohmann::ordered_json& answer,
                    Diagnostics& diagnostics) {
  const std::string& file = work.picture.file;
  const host::SceneCamera& camera = moment.world().cameras[work.picture.camera];
  host::RenderInput input = moment.input();
  input.camera = with_lens(options, camera);
  input.camera_motion = camera.motion;
  if (!host::check_camera(input.camera, diagnostics)) return false;
  const host::RenderSettings& settings = moment.settings();
  host::Scene displaced;
  if (options.dice > 0.0f && moment.displaces()) {
    displaced = work.is_last_of_world ? moment.take_world() : moment.world();
    displace(options, settings, displaced, input, diagnostics);
    input.scene = &displaced;
  } else if (work.of > 1) {
    input.bvh = moment.bvh(diagnostics);
    if (input.bvh == nullptr) return false;
  }

  const std::vector<const BoundKernel*> kernels = moment.shaders().kernels();
  if (!check_output({"--out", file}, kernels, diagnostics)) return false;
  const Enough enough(options.progress.time_limit);
  std::optional<host::Checkpoint> checkpoint;
  if (!options.progress.checkpoint.empty()) {
    const auto key = render_key(options, opened, input, settings, kernels, diagnostics);
    if (!key) return false;
    checkpoint.emplace(options.progress.checkpoint, *key, options.progress.checkpoint_every);
  }
  ProgressLine line(title(work), options.common.quiet);
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
  auto film = host::render(input, settings, diagnostics, control, &statistics);
  report_left_out(statistics, diagnostics);
  report_failed(opened, moment.assignments(), moment.shaders(), diagnostics);
  for (const BoundKernel* kernel : kernels) {
    report_code(*kernel, options.common.shader_options(), diagnostics);
  }
  if (!film) return false;
  if (settings.noise > 0 && !options.common.quiet) {
    fmt::print(stderr, "{}\n", samples_text(statistics, settings));
  }
  report_samples(statistics, settings, enough, diagnostics);
  if (!is_written(options, statistics)) return false;
  if (work.denoiser != nullptr && !work.denoiser->denoise(*film, diagnostics)) return false;
  if (!host::write_image(*film, file, options.write, diagnostics)) return false;
  if (!statistics.is_whole && !enough.is_out_of_time()) {
    keep_promise_partly(file, samples_text(statistics, settings));
  }
  file_is_written(file, options.common.quiet || options.json);
  report_crop(settings, file, diagnostics);
  answer = written_picture(options, settings, work.picture, statistics);
  if (work.denoiser != nullptr) answer["denoised"] = film->denoised_by;
  // What comes next, or is asked for next, is another render.
  std::error_code none;
  if (options.series.is_series() && checkpoint)
    std::filesystem::remove(options.progress.checkpoint, none);
  return true;
}

}  // namespace nacre::tool
