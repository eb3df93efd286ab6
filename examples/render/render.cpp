#include "examples/render/render.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <thread>

#include "examples/common/leave_cores.h"
#include "examples/common/run_on_threads.h"
#include "examples/render/accumulation.h"
#include "examples/render/camera.h"
#include "examples/render/camera_paths.h"
#include "examples/render/render_context.h"
#include "examples/render/tiles.h"
#include "examples/render/wavefront.h"
#include "runtime/float_environment.h"

namespace nacre::host {

namespace {

/// Paths of a tile that are followed together.
constexpr int wave_size = 4096;

/// What the threads of one render share.
struct Shared {
  const RenderContext& context;
  const RenderControl& control;
  const std::vector<Tile>& tiles;
  TileQueue& queue;
  Accumulation& sums;
  const Film& film;  ///< What is to be filled.
  Diagnostics& diagnostics;
  RenderStatistics& statistics;  ///< Added to under the mutex, read while no tile is at work.
  std::mutex mutex = {};
};

/// Adds samples to a tile; as many as it has then, which are fewer than wanted where the render
/// ends before.
int render_tile(Shared& shared, const TileWork& work, CameraPaths& camera, Wavefront& wavefront,
                std::vector<Path>& paths) {
  const Tile& tile = shared.tiles[work.tile];
  const int width = tile.width();
  const int pixels = static_cast<int>(tile.pixels()), at_once = std::max(1, wave_size / pixels);
  for (int first = work.first; first < work.last; first += at_once) {
    const bool ends = shared.control.stop.stop_requested() ||
                      (first > 0 && shared.control.enough.stop_requested());
    if (ends) return first;
    const int last = std::min(first + at_once, work.last);
    camera.begin(tile, first, last, paths);
    wavefront.trace(paths);
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const int i = static_cast<int>(k) % pixels;
      const std::size_t pixel = shared.sums.index(tile.x0 + i % width, tile.y0 + i / width);
      shared.sums.add(pixel, paths[k].radiance, paths[k].alpha);
      if (shared.film.passes.empty()) continue;
      const int sample = first + static_cast<int>(k) / pixels;
      shared.sums.add(pixel, sample, wavefront.record(k));
    }
  }
  return work.last;
}

/// Whether a tile with so many samples is as good as asked for.
bool is_good(const Shared& shared, std::size_t tile, int done) {
  const RenderSettings& s = shared.context.settings;
  return s.noise > 0.0 && done >= s.least_samples && shared.queue.is_end(done) &&
         shared.sums.error(shared.tiles[tile], done) <= s.noise;
}

void save(Shared& shared) {
  shared.control.checkpoint->save(
      shared.queue.done(), shared.statistics,
      [&](std::string& bytes) { shared.sums.append_to(bytes); }, shared.diagnostics);
}

void work(Shared& shared) {
  const RenderSettings& s = shared.context.settings;
  const auto most = static_cast<std::size_t>(std::max(wave_size, s.tile_size * s.tile_size));
  // Embree asks for flushed denormals, and the image must not depend on the caller's modes.
  const ScopedFloatEnvironment environment;
  Wavefront wavefront(shared.context, most);
  CameraPaths camera(shared.context);
  std::vector<Path> paths;
  paths.reserve(most);
  while (const auto work = shared.queue.take()) {
    const int done = render_tile(shared, *work, camera, wavefront, paths);
    {
      const std::lock_guard lock(shared.mutex);
      shared.statistics.add(wavefront.take_counts());
    }
    if (shared.control.enough.stop_requested()) shared.queue.wrap_up();
    const bool is_over = shared.control.stop.stop_requested();
    if (is_over) shared.queue.close();
    shared.queue.give_back(*work, done, is_good(shared, work->tile, done),
                           is_over ? nullptr : shared.control.progress);
    Checkpoint* const checkpoint = shared.control.checkpoint;
    if (checkpoint == nullptr || !checkpoint->is_due()) continue;
    shared.queue.pause([&] {
      if (checkpoint->is_due()) save(shared);
    });
  }
}

void count_samples(const std::vector<Tile>& tiles, const std::vector<int>& done,
                   RenderStatistics& statistics) {
  double samples = 0, pixels = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto size = static_cast<double>(tiles[i].pixels());
    samples += done[i] * size;
    pixels += size;
  }
  statistics.mean_samples = samples / pixels;
  statistics.least_samples = *std::ranges::min_element(done);
  statistics.most_samples = *std::ranges::max_element(done);
}

/// What is traced. Samples that are taken until a tile is good enough are taken for all of it: it
/// has as many then as in the whole image.
std::vector<Tile> traced_tiles(const RenderSettings& s) {
  std::vector<Tile> tiles = make_tiles(s.width, s.height, s.tile_size, window_of(s));
  return s.noise > 0.0 ? tiles : cut_tiles(std::move(tiles), window_of(s));
}

/// Samples of a tile's pixels that are traced together, for TileQueue: the same for any window.
int samples_at_once(const RenderSettings& s) {
  const int pixels = std::min(s.tile_size, s.width) * std::min(s.tile_size, s.height);
  return std::max(1, wave_size / pixels);
}

/// Goes on with what a checkpoint has. False with an error.
bool resume(const RenderControl& control, std::vector<int>& done, RenderCounts& counts,
            Accumulation& sums, Diagnostics& diagnostics) {
  if (control.checkpoint == nullptr) return true;
  const std::size_t errors = diagnostics.error_count();
  const Checkpoint::Content content = control.checkpoint->load(diagnostics);
  if (diagnostics.error_count() != errors) return false;
  if (content.done.empty()) return true;
  if (content.done.size() == done.size() && sums.assign(content.sums)) {
    done = content.done;
    counts = content.counts;
    return true;
  }
  diagnostics.error("bad-checkpoint", {}, "the checkpoint is of an image of another size");
  return false;
}

}  // namespace

std::optional<Film> render(const RenderInput& input, const RenderSettings& settings,
                           Diagnostics& diagnostics, const RenderControl& control,
                           RenderStatistics* statistics) try {
  if (!check_camera(input.camera, diagnostics)) return {};
  const RenderContext context(input, settings, diagnostics);
  if (!context.bvh.ok()) return {};
  const std::vector<Tile> tiles = traced_tiles(settings);
  Film film(settings.width, settings.height, context.any_matte, window_of(settings));
  film.passes =
      PassFilm(settings.passes, *input.scene, input.material_names, film.window().pixels());
  Accumulation sums(settings.passes, film, window_of(tiles));
  std::vector<int> done(tiles.size());
  RenderStatistics found;
  if (!resume(control, done, found, sums, diagnostics)) return {};
  TileQueue queue(done, settings.samples, samples_at_once(settings));
  Shared shared{context, control, tiles, queue, sums, film, diagnostics, found};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (is_good(shared, i, done[i])) queue.finish(i);
  }
  const auto threads = static_cast<int>(
      std::min(tiles.size(), static_cast<std::size_t>(thread_count(settings.threads))));
  std::atomic<int> next_thread = 0;
  std::atomic<bool> has_ended = false;
  run_on_threads(threads, [&] {
    try {
      if (control.pending) {
        leave_cores(next_thread++, threads, control.pending, [&] {
          return has_ended || control.stop.stop_requested() || control.enough.stop_requested();
        });
      }
      work(shared);
      has_ended = true;
    } catch (...) {
      has_ended = true;
      queue.close();
      throw;
    }
  });
  count_samples(tiles, queue.done(), shared.statistics);
  shared.statistics.is_whole = queue.is_finished();
  for (std::size_t i = 0; i < tiles.size() && settings.noise > 0; ++i) {
    const int samples = queue.done()[i];
    shared.statistics.noisy_tiles += samples == settings.samples && !is_good(shared, i, samples);
  }
  if (statistics != nullptr) *statistics = shared.statistics;
  if (control.checkpoint != nullptr && !control.stop.stop_requested()) save(shared);
  if (control.stop.stop_requested() || shared.statistics.least_samples == 0) return {};
  sums.develop(tiles, queue.done(), film);
  return film;
} catch (const std::bad_alloc&) {
  diagnostics.error("out-of-memory", {}, "the render needs more memory than there is");
  return {};
}

}  // namespace nacre::host
