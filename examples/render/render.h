#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "examples/render/bvh.h"
#include "examples/render/checkpoint.h"
#include "examples/render/environment.h"
#include "examples/render/film.h"
#include "examples/render/light_shader.h"
#include "examples/render/passes.h"
#include "examples/render/pixel_window.h"
#include "examples/render/render_counts.h"
#include "examples/render/sampler.h"
#include "examples/render/scene.h"
#include "examples/render/shader.h"
#include "examples/render/techniques.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// How direct light is found. All three converge to the same image; the first
/// two exist to show it.
enum class Strategy {
  bsdf_only,            ///< Only directions that the material draws.
  light_only,           ///< Only directions that the lights draw (Dirac lobes excepted).
  multiple_importance,  ///< Both, by the power heuristic.
};

enum class PixelFilter {
  box,   ///< The pixel's square.
  tent,  ///< Two pixels wide, by importance sampling, so pixels stay independent.
};

struct RenderSettings {
  int width = 512, height = 512;
  int samples = 16;            ///< Per pixel.
  int max_depth = 8;           ///< Scattering events on a path; 0: emission only.
  int max_scatterings = 2048;  ///< Within media, on a path; Russian roulette is on from the first.
  int roulette_depth = 4;    ///< Scattering events before Russian roulette; above max_depth: never.
  int max_transparent = 64;  ///< Surfaces that one path or shadow ray passes through.
  int threads = 0;           ///< 0: as many as the machine has.
  std::uint32_t seed = 0;
  SamplerKind sampler = SamplerKind::sobol;
  Strategy strategy = Strategy::multiple_importance;
  PixelFilter filter = PixelFilter::box;
  float time = 0.f;
  float frame = 1.f;
  /// Seconds from `time`: rays have times between. Where they are equal nothing is blurred.
  float shutter_open = 0.f, shutter_close = 0.f;
  float fps = 24.f;                ///< What `frame` is counted in while the shutter is open.
  int tile_size = 32;              ///< Pixels on a side.
  std::uint32_t batch_size = 512;  ///< Points per kernel call, at most.
  PassRequest passes = {};         ///< Images beside the picture.
  Techniques techniques = {};
  /// What is traced and stored of the image; nothing: all. Pixels have the bits that they have in
  /// the whole.
  std::optional<PixelWindow> crop = {};
  /// Not 0: a tile has enough samples once its error, as Accumulation::error estimates it, is at
  /// most that; `samples` at most, least_samples at least.
  double noise = 0.0;
  int least_samples = 16;
};

inline PixelWindow window_of(const RenderSettings& s) {
  return s.crop.value_or(PixelWindow{0, 0, s.width, s.height});
}

/// Whether rays have times of their own.
inline bool is_open(const RenderSettings& s) { return s.shutter_close > s.shutter_open; }

struct RenderInput {
  const Scene* scene = nullptr;
  /// One per mesh of the scene; ignored, and may be null, for area lights.
  std::vector<const Shader*> shaders;
  const Environment* environment = nullptr;  ///< Null: black.
  Camera camera;
  /// Those of the backs, where dot(Ng, wo) < 0: null where the front's is on both
  /// sides, and empty where that is so for every mesh.
  std::vector<const Shader*> back_shaders = {};
  Motion camera_motion = {};                    ///< As Scene has it.
  std::vector<const LightShader*> lights = {};  ///< That no ray meets.
  /// By mesh: closed, light enters it, and its shaders have an interior() and read
  /// ShadingBatch::exterior_index. Where these overlap Mesh::priority decides. Empty: none.
  std::vector<bool> solids = {};
  /// What rays are traced against, of `scene`, for who renders it several times; null: made anew.
  const Bvh* bvh = nullptr;
  /// By mesh, for mattes: what it is shaded by. Empty: as Mesh::material_name says.
  std::vector<std::string> material_names = {};
};

struct RenderControl {
  std::stop_token stop = {};  ///< Ends the render between batches of samples: there is no film.
  /// The same, but there is: of the samples that were taken.
  std::stop_token enough = {};
  /// Called with the finished share, 0 to 1, from one thread at a time.
  std::function<void(double)> progress = {};
  /// How many kernels are still being compiled, from any thread: as many threads wait, so
  /// that compiling has cores. Empty: none.
  std::function<int()> pending = {};
  /// Where work is kept now and then, for another process to go on with; null: nowhere.
  Checkpoint* checkpoint = nullptr;
};

/// Of a picture: of all runs that it took, if it went on from a checkpoint.
struct RenderStatistics : RenderCounts {
  /// Samples that pixels have: of tiles, the fewest and the most, and the mean of all pixels.
  int least_samples = 0, most_samples = 0;
  double mean_samples = 0;
  bool is_whole = false;        ///< Whether that is all that was asked for.
  std::size_t noisy_tiles = 0;  ///< Beyond RenderSettings::noise, with all samples.
};

/// Path traces the scene. The film is the same, bit for bit, for any number of
/// threads, and however often it was interrupted and went on from a checkpoint; on CPUs of another
/// kind Embree may round a hit, and so a picture, differently. Empty when cancelled, when a
/// checkpoint is of another render, or when memory ran out (which give an error).
std::optional<Film> render(const RenderInput& input, const RenderSettings& settings,
                           Diagnostics& diagnostics, const RenderControl& control = {},
                           RenderStatistics* statistics = nullptr);

}  // namespace nacre::host
