#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "examples/common/atomic_file.h"
#include "examples/common/image_writer.h"
#include "examples/render/image_io.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/render/answer.h"
#include "examples/tool/render/checkpoint.h"
#include "examples/tool/render/crop_option.h"
#include "examples/tool/render/moment.h"
#include "examples/tool/render/options.h"
#include "examples/tool/render/picture.h"
#include "examples/tool/render/report_once.h"
#include "examples/tool/render/request.h"
#include "examples/tool/render/series_options.h"
#include "examples/tool/render/world.h"
#include "examples/tool/scene/materials.h"
#include "examples/tool/stop.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// A run on its way: what is made once, and what was said.
struct Run {
  RenderOptions& options;
  Json& answer;
  std::vector<int> frames;  ///< Of --frames.
  ReportOnce once;
  Opened opened;
  std::optional<host::Environment> sky;
  std::unique_ptr<host::Denoiser> denoiser;  ///< Null: nobody asks for one.
  host::Scene world;                         ///< As it stands at RenderSettings::time.
  std::vector<Picture> pictures;
};

/// Sets the time of a frame, N / fps seconds after that of the run.
void set_frame(RenderOptions& options, float start, int frame) {
  host::RenderSettings& s = options.settings;
  s.frame = static_cast<float>(frame);
  s.time = start + s.frame / s.fps;
}

/// What is asked for, before anything is read. False after an error.
bool check(Run& run, Diagnostics& diagnostics) {
  complete_request(run.options, diagnostics);
  if (run.options.series.frames) {
    run.frames = parse_frames(*run.options.series.frames, diagnostics).value_or(std::vector<int>{});
  }
  return !diagnostics.has_errors() && check_series(run.options, run.frames, diagnostics);
}

/// Reads the document and the scene. False after an error, or where only a document of the scene's
/// materials is asked for.
bool open_all(Run& run, Diagnostics& diagnostics) {
  RenderOptions& options = run.options;
  const bool has_own = has_own_materials(options);
  if (!has_own) run.opened = open(options.common, diagnostics);
  if (!has_own && !run.opened) return false;
  if (!has_own && find_materials(*run.opened.document).empty()) {
    diagnostics.warning("no-material", {options.common.file, 0, 0, {}},
                        "the document has no material: everything is shown in neutral grey");
  }
  if (!options.out.empty() && !host::is_image_name(options.out, diagnostics)) return false;
  const bool is_one = run.frames.empty() && options.series.cameras.empty();
  if (is_one && !options.out.empty() && !host::prepare_image(options.out, diagnostics)) {
    return false;
  }
  if (!options.points_file.empty() && !host::prepare_output(options.points_file, diagnostics)) {
    return false;
  }
  run.world = load_world(options, diagnostics);
  if (has_own && !diagnostics.has_errors()) {
    run.opened = open_scene_materials(options, run.world, diagnostics);
    if (!run.opened || options.out.empty()) return false;
  }
  if (options.denoise.is_asked) {
    run.denoiser =
        host::Denoiser::load(options.denoise.library, options.common.threads, diagnostics);
  }
  if (const auto view = load_view(options.view, options.common.ocio, diagnostics)) {
    options.write.view = [view](std::span<float> rgb) { view->apply(rgb); };
    options.write.view_name = view->names().display + ", " + view->names().view;
  }
  run.sky = load_environment(options, diagnostics);
  return !diagnostics.has_errors() && run.sky;
}

/// What is to be made, those that are there already left out. False after an error.
bool list(Run& run, Diagnostics& diagnostics) {
  const RenderOptions& options = run.options;
  const auto cameras = choose_cameras(options.series, run.world, options.scene, diagnostics);
  if (!cameras) return false;
  auto pictures =
      list_pictures(options.series, run.frames, *cameras, run.world, options.out, diagnostics);
  if (!pictures) return false;
  withdraw_promise(options.out);  // It may be a pattern, of as many files as there are pictures.
  std::vector<std::string> files;
  // A document of the scene's own materials is written, and no file that was there.
  const std::vector<std::string> read =
      has_own_materials(options) ? std::vector<std::string>() : run.opened.document->files();
  std::vector<OutputFile> outputs = outputs_of(options);
  for (Picture& each : *pictures) {
    outputs.front().file = each.file;
    if (!check_outputs(outputs, read, diagnostics)) return false;
    std::error_code none;
    if (options.series.skips_existing && std::filesystem::exists(each.file, none)) {
      run.answer["pictures"].push_back(skipped_picture(options, each));
      report_skipped(each.file, diagnostics);
      continue;
    }
    if (!host::prepare_image(each.file, diagnostics)) return false;
    files.push_back(each.file);
    run.pictures.push_back(std::move(each));
  }
  promise_files(files);
  return true;
}

/// The scene at the time of the next picture, in place of that of the one before.
std::unique_ptr<RenderMoment> next_moment(Run& run, std::unique_ptr<RenderMoment> before,
                                          bool is_loaded, RenderShaders& shaders,
                                          Diagnostics& diagnostics) {
  if (before != nullptr) run.world = before->take_world();
  before.reset();
  if (!is_loaded) run.world = load_world(run.options, diagnostics);
  if (diagnostics.has_errors()) return nullptr;
  return RenderMoment::create(run.options, run.opened, std::move(run.world), *run.sky, shaders,
                              diagnostics);
}

/// What --record-points asks for.
void write_points(const Run& run, const RenderShaders& shaders, Diagnostics& diagnostics) {
  const std::string& file = run.options.points_file;
  const RecordedPoints points = shaders.recorded();
  if (points.is_empty()) {
    diagnostics.error("nothing-recorded", {.file = file, .path = {}},
                      "no material was shaded anywhere",
                      "a picture that is rendered in this run and shows one", "none");
    return;
  }
  if (!host::write_text_atomically(file, points.text(), diagnostics)) return;
  file_is_written(file, run.options.common.quiet || run.options.json);
}

/// All pictures, one after another: each is in its file before the next begins.
void render_all(Run& run) {
  RenderOptions& options = run.options;
  const float start = options.settings.time;
  const bool is_animated = run.world.is_animated;
  if (!run.frames.empty()) set_frame(options, start, run.frames.front());
  std::optional<int> loaded;
  if (!run.frames.empty()) loaded = run.frames.front();
  RenderStop stop;
  Diagnostics diagnostics;
  RenderShaders shaders(options, run.opened, stop);
  std::unique_ptr<RenderMoment> moment;
  take_time_to_stop(5.0);
  for (std::size_t i = 0; i < run.pictures.size() && !tool::stop().is_due(); ++i) {
    Diagnostics said;
    const Picture& picture = run.pictures[i];
    const bool is_new = moment == nullptr || picture.frame != run.pictures[i - 1].frame;
    if (is_new && picture.frame) set_frame(options, start, *picture.frame);
    if (is_new) {
      const bool is_there = !is_animated || picture.frame == loaded;
      moment = next_moment(run, std::move(moment), is_there, shaders, said);
      loaded = picture.frame;
    }
    const bool is_last = i + 1 == run.pictures.size();
    const bool is_spare = is_last || (is_animated && run.pictures[i + 1].frame != picture.frame);
    Json answer = unwritten_picture(options, picture);
    const bool is_written =
        moment != nullptr &&
        render_picture(options, run.opened, *moment,
                       {picture, i + 1, run.pictures.size(), is_spare, run.denoiser.get()}, stop,
                       answer, said);
    run.answer["pictures"].push_back(std::move(answer));
    if (is_last || !is_written) report_texels(*run.opened.system, said);
    run.once.say(said);
    if (!is_written) return run.once.fail();
  }
  if (options.points_file.empty() || tool::stop().is_due()) return;
  Diagnostics said;
  write_points(run, shaders, said);
  run.once.say(said);
}

int run(RenderOptions& options, Json& answer) {
  Run run{options, answer, {}, {}, {}, {}, {}, {}, {}};
  Diagnostics diagnostics;
  if (!check(run, diagnostics)) {
    run.once.say(diagnostics);
    return status_usage;
  }
  promise_files({options.out, options.document, options.points_file});
  const float start = options.settings.time;
  if (!run.frames.empty()) set_frame(options, start, run.frames.front());
  const bool is_ready = open_all(run, diagnostics) && list(run, diagnostics);
  options.settings.time = start;
  run.once.say(diagnostics);
  if (is_ready) render_all(run);
  return run.once.status();
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
    Json answer{{"pictures", Json::array()}};
    status = guarded(named.empty() ? options->scene : named, [&] { return run(*options, answer); });
    if (options->json && status != status_usage) print_json(final_answer(*options, answer));
  });
}

}  // namespace nacre::tool
