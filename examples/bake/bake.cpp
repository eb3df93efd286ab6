#include "examples/bake/bake.h"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <mutex>
#include <optional>

#include "examples/bake/adaptive_texels.h"
#include "examples/bake/filtered_texels.h"
#include "examples/bake/ordered_blocks.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/texel_sampler.h"
#include "examples/common/leave_cores.h"
#include "examples/common/run_on_threads.h"

namespace nacre::host {

namespace {

/// Processor time of this thread, in seconds.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What one thread bakes with.
class Baker {
 public:
  Baker(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
        FilteredTexels::Start& start)
      : shader_(kernel, output, settings), leaves_gaps_(settings.surface != nullptr) {
    const Sampling& sampling = settings.sampling;
    if (!has_mean(kernel.outputs[output].type)) {
      fixed_.emplace(shader_, 1);
    } else if (sampling.count > 0) {
      fixed_.emplace(shader_, sampling.count);
    } else if (shader_.reads_footprints()) {
      filtered_.emplace(shader_, sampling.error, start);
    } else {
      adaptive_.emplace(shader_, sampling.error);
    }
  }

  RunStatus rows(BakedRows& block, const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
    block.planes.resize(static_cast<std::size_t>(shader_.components()));
    const RunStatus status = sample(block, stop, counts);
    if (leaves_gaps_) note_gaps(block);
    return status;
  }

 private:
  RunStatus sample(BakedRows& block, const std::atomic<std::uint32_t>& stop, BakeCounts& counts) {
    const auto rows = [&](auto& texels) {
      return texels.rows(block.first, block.rows, block.planes, stop, counts);
    };
    if (filtered_) return rows(*filtered_);
    return adaptive_ ? rows(*adaptive_) : rows(*fixed_);
  }

  void note_gaps(BakedRows& block) const {
    const auto width = static_cast<std::size_t>(shader_.width());
    const std::size_t first = static_cast<std::size_t>(block.first) * width;
    block.covered.resize(static_cast<std::size_t>(block.rows) * width);
    for (std::size_t i = 0; i < block.covered.size(); ++i) {
      block.covered[i] = shader_.covers(first + i) ? 1 : 0;
    }
  }

  PointShader shader_;
  bool leaves_gaps_;
  std::optional<TexelSampler> fixed_;
  std::optional<AdaptiveTexels> adaptive_;
  std::optional<FilteredTexels> filtered_;
};

}  // namespace

bool has_mean(Type type) { return type != Type::boolean && type != Type::integer; }

BakeResult bake(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                int block_rows, const RowSink& sink, const BakeControl& control,
                BakeCounts* counts) {
  const int blocks = (settings.height + block_rows - 1) / block_rows;
  const int threads = std::min(thread_count(settings.threads), blocks);
  // Ends all blocks that are being computed: asked for, or because one of them failed.
  std::atomic<std::uint32_t> ends = 0;
  std::atomic<bool> too_many_steps = false;
  std::atomic<bool> is_refused = false;
  std::atomic<int> next_thread = 0;
  OrderedBlocks queue(blocks, 4 * threads, ends);
  const std::stop_callback asked(control.stop, [&] {
    ends = 1;
    queue.wake();
  });
  FilteredTexels::Start first_squares;
  std::mutex counting;
  BakeCounts all;
  run_on_threads(threads, [&] {
    try {
      Baker baker(kernel, output, settings, first_squares);
      BakeCounts mine;
      leave_cores(
          next_thread++, threads, [&] { return kernel.kernel.is_pending() ? 1 : 0; },
          [&] { return queue.is_begun() || ends != 0; });
      while (const std::optional<int> number = queue.begin()) {
        BakedRows block{*number * block_rows,
                        std::min(block_rows, settings.height - *number * block_rows),
                        {},
                        {}};
        const double start = thread_seconds();
        const RunStatus status = baker.rows(block, ends, mine);
        mine.shading_seconds += thread_seconds() - start;
        if (status == RunStatus::stopped) break;
        if (status != RunStatus::done) {
          assert(status == RunStatus::too_many_steps);  // It has what its Program asks for.
          too_many_steps = true;
          ends = 1;
          break;
        }
        const double share = static_cast<double>(block.first + block.rows) / settings.height;
        const bool is_taken = queue.finish(*number, [&control, share, rest = sink(block)] {
          const bool is_right = rest();
          if (is_right && control.progress) control.progress(share);
          return is_right;
        });
        if (!is_taken) is_refused = true;
      }
      queue.wake();
      const std::lock_guard guard(counting);
      all.samples += mine.samples;
      all.unfinished += mine.unfinished;
      all.shading_seconds += mine.shading_seconds;
    } catch (...) {
      ends = 1;
      queue.wake();
      throw;
    }
  });
  if (counts != nullptr) *counts = all;
  if (too_many_steps) return BakeResult::too_many_steps;
  if (is_refused) return BakeResult::refused;
  return ends != 0 ? BakeResult::stopped : BakeResult::done;
}

void report_too_many_steps(const OutputKernel::Output& output, Diagnostics& diagnostics) {
  diagnostics.error("too-many-steps", output.where,
                    "output '" + output.name +
                        "' takes too many steps for a point, or a loop of it does not end");
}

std::vector<float> bake_image(const OutputKernel& kernel, std::size_t output,
                              const BakeSettings& settings) {
  constexpr int block_rows = 8;
  std::vector<float> image;
  const auto append = [&](BakedRows& block) {
    return [&image, planes = std::move(block.planes)] {
      for (std::size_t i = 0; i < planes[0].size(); ++i) {
        for (const std::vector<float>& plane : planes) image.push_back(plane[i]);
      }
      return true;
    };
  };
  const BakeResult result = bake(kernel, output, settings, block_rows, append);
  if (result != BakeResult::done) image.clear();
  return image;
}

}  // namespace nacre::host
