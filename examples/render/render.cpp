#include "examples/render/render.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <thread>

#include "examples/common/leave_cores.h"
#include "examples/common/run_on_threads.h"
#include "examples/render/camera.h"
#include "examples/render/render_context.h"
#include "examples/render/wavefront.h"
#include "runtime/float_environment.h"

namespace nacre::host {

namespace {

/// Paths of a tile that are followed together.
constexpr int wave_size = 4096;

struct Tile {
  int x0, y0, x1, y1;
  int pixels() const { return (x1 - x0) * (y1 - y0); }
};

std::vector<Tile> make_tiles(const RenderSettings& s) {
  std::vector<Tile> tiles;
  for (int y = 0; y < s.height; y += s.tile_size) {
    for (int x = 0; x < s.width; x += s.tile_size) {
      tiles.push_back(
          {x, y, std::min(x + s.tile_size, s.width), std::min(y + s.tile_size, s.height)});
    }
  }
  return tiles;
}

/// From the distribution even on [0, 1) to the tent on (-1, 1).
float tent(float u) {
  return u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f * (1.f - u));
}

Path camera_path(const RenderContext& context, int x, int y, int sample) {
  const RenderSettings& s = context.settings;
  Path path;
  path.key = {s.seed,
              static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(s.width) +
                  static_cast<std::uint32_t>(x),
              static_cast<std::uint32_t>(sample), 0};
  const Uniform2 u = uniform2(s.sampler, path.key, Draw::pixel);
  const bool box = s.filter == PixelFilter::box;
  const float dx = box ? u.x : 0.5f + tent(u.x);
  const float dy = box ? u.y : 0.5f + tent(u.y);
  const float time = is_open(s) ? uniform2(s.sampler, path.key, Draw::time).x : 0.f;
  const PixelCamera::Ray ray =
      context.camera.ray(static_cast<float>(x) + dx, static_cast<float>(y) + dy,
                         uniform2(s.sampler, path.key, Draw::lens), time);
  path.ray = {ray.origin, ray.direction, INFINITY, ray_camera, time};
  path.vertex = ray.origin;
  path.media = context.camera_media;
  return path;
}

/// All samples of one tile. False when stopped before the end.
bool render_tile(const RenderContext& context, const Tile& tile, const std::stop_token& stop,
                 Wavefront& wavefront, std::vector<Path>& paths, Film& film) {
  const int width = tile.x1 - tile.x0;
  const int at_once = std::max(1, wave_size / tile.pixels());
  std::vector<PixelSum> sums(static_cast<std::size_t>(tile.pixels()));
  PassSums passes(context.settings.passes, film.passes, sums.size());
  for (int first = 0; first < context.settings.samples; first += at_once) {
    if (stop.stop_requested()) return false;
    const int last = std::min(first + at_once, context.settings.samples);
    paths.clear();
    for (int sample = first; sample < last; ++sample) {
      for (int i = 0; i < tile.pixels(); ++i) {
        paths.push_back(camera_path(context, tile.x0 + i % width, tile.y0 + i / width, sample));
      }
    }
    wavefront.trace(paths);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      sums[i % sums.size()].add(paths[i].radiance, paths[i].alpha);
      if (!film.passes.empty()) passes.add(i % sums.size(), wavefront.record(i));
    }
  }
  for (int i = 0; i < tile.pixels(); ++i) {
    const PixelSum& sum = sums[static_cast<std::size_t>(i)];
    const int x = tile.x0 + i % width, y = tile.y0 + i / width;
    film.mean(x, y) = sum.mean();
    film.variance(x, y) = sum.variance_of_mean();
    if (film.has_alpha()) film.set_alpha(x, y, sum.alpha());
    if (!film.passes.empty()) {
      passes.store(static_cast<std::size_t>(i), film.index(x, y), film.passes);
    }
  }
  return true;
}

/// What the threads of one render write to, besides their own pixels.
struct Shared {
  std::atomic<std::size_t> next_tile = 0;
  std::mutex mutex;  ///< Guards what follows.
  std::size_t done = 0;
  RenderStatistics statistics;
};

void add(RenderStatistics& sum, const RenderStatistics& s) {
  sum.paths += s.paths;
  sum.rays += s.rays;
  sum.shadow_rays += s.shadow_rays;
  sum.invalid_results += s.invalid_results;
  sum.beyond_bound += s.beyond_bound;
  sum.media_dropped += s.media_dropped;
  sum.paths_cut += s.paths_cut;
  sum.shading_seconds += s.shading_seconds;
  sum.tracing_seconds += s.tracing_seconds;
}

void work(const RenderContext& context, const std::vector<Tile>& tiles,
          const RenderControl& control, Shared& shared, Film& film) {
  const int tile_pixels = context.settings.tile_size * context.settings.tile_size;
  const auto most = static_cast<std::size_t>(std::max(wave_size, tile_pixels));
  // Embree asks for flushed denormals, and the image must not depend on the caller's modes.
  const ScopedFloatEnvironment environment;
  Wavefront wavefront(context, most);
  std::vector<Path> paths;
  paths.reserve(most);
  while (true) {
    const std::size_t i = shared.next_tile++;
    if (i >= tiles.size()) break;
    if (!render_tile(context, tiles[i], control.stop, wavefront, paths, film)) break;
    const std::lock_guard lock(shared.mutex);
    ++shared.done;
    if (control.progress) {
      control.progress(static_cast<double>(shared.done) / static_cast<double>(tiles.size()));
    }
  }
  const std::lock_guard lock(shared.mutex);
  add(shared.statistics, wavefront.statistics());
}

}  // namespace

std::optional<Film> render(const RenderInput& input, const RenderSettings& settings,
                           Diagnostics& diagnostics, const RenderControl& control,
                           RenderStatistics* statistics) try {
  if (!check_camera(input.camera, diagnostics)) return {};
  const RenderContext context(input, settings, diagnostics);
  if (!context.bvh.ok()) return {};
  const std::vector<Tile> tiles = make_tiles(settings);
  Film film(settings.width, settings.height, context.any_matte);
  film.passes = PassFilm(settings.passes, *input.scene, input.material_names, settings.width,
                         settings.height);
  Shared shared;
  const auto threads = static_cast<int>(
      std::min(tiles.size(), static_cast<std::size_t>(thread_count(settings.threads))));
  std::atomic<int> next_thread = 0;
  run_on_threads(threads, [&] {
    try {
      if (control.pending) {
        leave_cores(next_thread++, threads, control.pending, [&] {
          return shared.next_tile >= tiles.size() || control.stop.stop_requested();
        });
      }
      work(context, tiles, control, shared, film);
    } catch (...) {
      shared.next_tile = tiles.size();
      throw;
    }
  });
  if (statistics != nullptr) *statistics = shared.statistics;
  if (shared.done != tiles.size()) return {};
  return film;
} catch (const std::bad_alloc&) {
  diagnostics.error("out-of-memory", {}, "the render needs more memory than there is");
  return {};
}

}  // namespace nacre::host
