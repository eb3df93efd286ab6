#pragma once

#include <optional>
#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// Which pictures `nacre render` makes of a scene.
struct SeriesOptions {
  std::vector<std::string> cameras;   ///< --camera: names, or "all"; empty: the first.
  std::optional<std::string> frames;  ///< --frames
  bool skips_existing = false;        ///< --skip-existing

  void add(CLI::App& command);
  /// Whether there may be several, however many are left to make.
  bool is_series() const { return !cameras.empty() || frames; }
};

/// One of them.
struct Picture {
  std::size_t camera = 0;    ///< Of the scene's,
  std::string camera_name;   ///< and SceneCamera::name.
  std::optional<int> frame;  ///< Of --frames.
  std::string file;
};

/// "1-24", "1-24x2", "1,5,9" and any of these after one another, each frame once. Nothing, with an
/// error, for what is no such list, runs backwards, or is of more than a million.
std::optional<std::vector<int>> parse_frames(const std::string& text, Diagnostics& diagnostics);

/// The numbers of the cameras that are asked for, each once, in that order; nothing, with an error,
/// where there is none of a name. A warning where the scene has several and nobody has chosen.
std::optional<std::vector<std::size_t>> choose_cameras(const SeriesOptions& options,
                                                       const host::Scene& scene,
                                                       const std::string& scene_file,
                                                       Diagnostics& diagnostics);

/// Every frame by every camera, frames being the slower. `pattern`: the name of a file, in which
/// {camera} stands for a camera's name, as a file may have it, where --camera is given; and
/// {frame}, or padded with zeros to N digits {0Nframe} or N times #, for the frame, where --frames
/// is. Nothing, with an error, where two had one name.
std::optional<std::vector<Picture>> list_pictures(const SeriesOptions& options,
                                                  const std::vector<int>& frames,
                                                  const std::vector<std::size_t>& cameras,
                                                  const host::Scene& scene,
                                                  const std::string& pattern,
                                                  Diagnostics& diagnostics);

}  // namespace nacre::tool
