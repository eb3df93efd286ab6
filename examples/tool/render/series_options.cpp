#include "examples/tool/render/series_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <set>
#include <string_view>

#include "examples/tool/file_stems.h"
#include "jit/graph/resolve/filename.h"
#include "runtime/near_names.h"

namespace nacre::tool {

namespace {

constexpr std::string_view all_cameras = "all", camera_token = "{camera}";
constexpr std::size_t most_frames = 1'000'000;

struct FrameSpan {
  int first = 0, last = 0, step = 1;
};

/// Takes a number off the front. False where there is none.
bool take_int(std::string_view& text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

/// "5", "1-24", "1-24x2", numbers with a sign or without.
std::optional<FrameSpan> parse_span(std::string_view text) {
  FrameSpan span;
  if (!take_int(text, span.first)) return {};
  span.last = span.first;
  const auto take = [&](char c, int& number) {
    if (!text.starts_with(c)) return true;
    text.remove_prefix(1);
    return take_int(text, number);
  };
  const bool is_range = text.starts_with('-');
  if (!take('-', span.last) || (is_range && !take('x', span.step)) || !text.empty()) return {};
  return span.last < span.first || span.step < 1 ? std::nullopt : std::optional(span);
}

/// Runs of # as numbers of so many digits.
std::string substitute_hashes(std::string_view text, int frame) {
  std::string result;
  while (!text.empty()) {
    const std::size_t run = std::min(text.find_first_not_of('#'), text.size());
    if (run > 0) result += fmt::format("{:0{}}", frame, run);
    text.remove_prefix(run);
    const std::size_t plain = std::min(text.find('#'), text.size());
    result += text.substr(0, plain);
    text.remove_prefix(plain);
  }
  return result;
}

std::string substitute_camera(std::string text, const std::string& stem) {
  for (std::size_t at = 0; (at = text.find(camera_token, at)) != std::string::npos;) {
    text.replace(at, camera_token.size(), stem);
    at += stem.size();
  }
  return text;
}

std::vector<std::string> names_of(const host::Scene& scene) {
  std::vector<std::string> names;
  for (const host::SceneCamera& each : scene.cameras) {
    if (!each.name.empty()) names.push_back(each.name);
  }
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 16;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
  }
  return names.size() > most ? text + ", ..." : text;
}

}  // namespace

void SeriesOptions::add(CLI::App& command) {
  command
      .add_option(
          "--camera", cameras,
          "Which of the scene's cameras (default: the first), or all: scene and kernels are "
          "made once, and {camera} in --out is the name")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...|all");
  command
      .add_option("--frames", frames,
                  "These frames, one after another, each as it stands N / --fps seconds after "
                  "--time: 1-24, 1-24x2, 1,5,9. In --out {frame}, {04frame} or #### is the number")
      ->excludes("--frame")
      ->type_name("FIRST-LASTxSTEP,...");
  command.add_flag("--skip-existing", skips_existing,
                   "Leave out pictures whose files are there: what was stopped goes on");
}

std::optional<std::vector<int>> parse_frames(const std::string& text, Diagnostics& diagnostics) {
  const auto fail = [&](std::string expected, std::string found) {
    diagnostics.error("bad-frames", {}, "these are no frames", std::move(expected),
                      std::move(found));
    return std::nullopt;
  };
  std::vector<int> frames;
  std::set<int> met;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const auto span = parse_span(part);
    if (!span)
      return fail("N, FIRST-LAST or FIRST-LASTxSTEP, with commas between", '\'' + part + '\'');
    for (std::int64_t frame = span->first; frame <= span->last; frame += span->step) {
      if (met.size() > most_frames) return fail(fmt::format("at most {}", most_frames), "more");
      if (met.insert(static_cast<int>(frame)).second) frames.push_back(static_cast<int>(frame));
    }
    begin = end + 1;
  }
  return frames;
}

std::optional<std::vector<std::size_t>> choose_cameras(const SeriesOptions& options,
                                                       const host::Scene& scene,
                                                       const std::string& scene_file,
                                                       Diagnostics& diagnostics) {
  const std::vector<std::string> names = names_of(scene);
  if (options.cameras.empty()) {
    if (names.size() > 1) {
      diagnostics.warning("several-cameras", {scene_file, 0, 0, {}},
                          "the first camera of the scene is taken", "--camera NAME,... or all",
                          listed(names));
    }
    return std::vector<std::size_t>{0};
  }
  std::vector<std::size_t> chosen;
  const auto choose = [&](std::size_t i) {
    if (std::ranges::find(chosen, i) == chosen.end()) chosen.push_back(i);
  };
  for (const std::string& name : options.cameras) {
    if (name == all_cameras) {
      for (std::size_t i = 0; i < names.size(); ++i) choose(i);
    } else if (const auto found = std::ranges::find(names, name); found != names.end()) {
      choose(static_cast<std::size_t>(found - names.begin()));
    } else {
      diagnostics.error("unknown-camera", {scene_file, 0, 0, {}},
                        "the scene has no camera of that name",
                        names.empty() ? "a scene with cameras" : listed(names) + " or all",
                        '\'' + name + '\'', near_hint(diagnostics, name, names));
      return {};
    }
  }
  if (!chosen.empty()) return chosen;
  diagnostics.error("unknown-camera", {scene_file, 0, 0, {}}, "the scene has no cameras",
                    "a scene with cameras, or no --camera");
  return {};
}

std::optional<std::vector<Picture>> list_pictures(const SeriesOptions& options,
                                                  const std::vector<int>& frames,
                                                  const std::vector<std::size_t>& cameras,
                                                  const host::Scene& scene,
                                                  const std::string& pattern,
                                                  Diagnostics& diagnostics) {
  FileStems stems;
  std::vector<std::string> by_camera;
  for (const std::size_t camera : cameras) {
    by_camera.push_back(options.cameras.empty()
                            ? pattern
                            : substitute_camera(pattern, stems.stem_of(scene.cameras[camera].name,
                                                                       {}, diagnostics)));
  }
  std::vector<Picture> pictures;
  std::set<std::string> files;
  const auto add = [&](std::size_t k, std::optional<int> frame) {
    std::string file = by_camera[k];
    if (frame) file = substitute_hashes(substitute_frame(file, *frame), *frame);
    files.insert(file);
    pictures.push_back({cameras[k], scene.cameras[cameras[k]].name, frame, std::move(file)});
  };
  for (std::size_t i = 0; i < std::max<std::size_t>(1, frames.size()); ++i) {
    for (std::size_t k = 0; k < cameras.size(); ++k) {
      add(k, frames.empty() ? std::nullopt : std::optional(frames[i]));
    }
  }
  if (files.size() == pictures.size() || pattern.empty()) return pictures;
  const bool lacks_camera = cameras.size() > 1 && pattern.find(camera_token) == std::string::npos;
  diagnostics.error("one-name", {pattern, 0, 0, {}}, "several pictures would have one name",
                    lacks_camera ? "{camera} in --out" : "{frame} or #### in --out",
                    fmt::format("{} pictures, {} names", pictures.size(), files.size()));
  return {};
}

}  // namespace nacre::tool
