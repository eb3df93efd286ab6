#include "examples/tool/render/progress_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "examples/tool/number_range.h"
#include "examples/tool/stop.h"

namespace nacre::tool {

void ProgressOptions::add(CLI::App& command) {
  command
      .add_option("--time-limit", time_limit,
                  "Seconds to render for, compiling aside: the image has the samples that there "
                  "are then (default: 0, none). Ctrl-C does the same")
      ->check(number_within(0, 1e9))
      ->type_name("S");
  CLI::Option* const file =
      command
          .add_option(
              "--checkpoint", checkpoint,
              "Keeps what was done so far, for the same command to go on from, with the bits "
              "of a render that nothing interrupted; of this kind of machine, and refused "
              "where a file has changed")
          ->type_name("FILE");
  command.add_option("--checkpoint-every", checkpoint_every, "How often")
      ->check(number_within(0, 1e9))
      ->needs(file)
      ->capture_default_str()
      ->type_name("S");
}

Enough::Enough(double time_limit) : on_signal_(stop().token(), [this] { source_.request_stop(); }) {
  if (!(time_limit > 0)) return;
  timer_ = std::jthread([this, time_limit](const std::stop_token& over) {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    never.wait_for(lock, over, std::chrono::duration<double>(time_limit), [] { return false; });
    if (over.stop_requested()) return;
    out_of_time_ = true;
    source_.request_stop();
  });
}

std::string samples_text(const host::RenderStatistics& statistics,
                         const host::RenderSettings& settings) {
  if (statistics.least_samples == statistics.most_samples) {
    return fmt::format("{} of {} samples a pixel", statistics.least_samples, settings.samples);
  }
  return fmt::format("{} to {}, {:.1f} in the mean, of {} samples a pixel",
                     statistics.least_samples, statistics.most_samples, statistics.mean_samples,
                     settings.samples);
}

void report_samples(const host::RenderStatistics& statistics, const host::RenderSettings& settings,
                    const Enough& enough, Diagnostics& diagnostics) {
  if (enough.is_out_of_time() && !statistics.is_whole) {
    diagnostics.warning("out-of-time", {}, "the time limit came before all samples",
                        fmt::format("{} a pixel", settings.samples),
                        samples_text(statistics, settings));
  } else if (settings.noise > 0 && statistics.noisy_tiles > 0) {
    diagnostics.warning("noisy", {}, "parts of the image are noisier than asked for", "more --spp",
                        fmt::format("{} tiles", statistics.noisy_tiles));
  }
}

}  // namespace nacre::tool
