#include "examples/bake/bake_filled.h"

#include <algorithm>
#include <atomic>

#include "examples/bake/ordered_blocks.h"
#include "examples/common/run_on_threads.h"

namespace nacre::host {

namespace {

/// Rows of a block: enough that what its surface is looked up for is worth it.
int rows_of_a_block(const BakeSettings& settings) {
  constexpr int texels = 1 << 15;
  return std::clamp(texels / std::max(settings.width, 1), 16, std::max(16, settings.height));
}

/// A whole output.
BakedRows whole(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings) {
  const std::size_t texels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  const auto components = static_cast<std::size_t>(component_count(kernel.outputs[output].type));
  BakedRows all{0, settings.height, {}, std::vector<std::uint8_t>(texels, 1)};
  all.planes.assign(components, std::vector<float>(texels));
  return all;
}

/// Copies `rows` rows of `from`, from row `row`, to those of `to` from row `at`.
void copy_rows(const BakedRows& from, int row, BakedRows& to, int at, int rows, int width) {
  const auto index = [width](int r) { return static_cast<std::ptrdiff_t>(r) * width; };
  for (std::size_t c = 0; c < to.planes.size(); ++c) {
    std::copy(from.planes[c].begin() + index(row), from.planes[c].begin() + index(row + rows),
              to.planes[c].begin() + index(at));
  }
  if (from.covered.empty()) return;
  std::copy(from.covered.begin() + index(row), from.covered.begin() + index(row + rows),
            to.covered.begin() + index(at));
}

/// Hands over the blocks of `all`.
BakeResult hand_over(const BakedRows& all, const BakeSettings& settings, int block_rows,
                     const RowSink& sink, const BakeControl& control) {
  const int blocks = (all.rows + block_rows - 1) / block_rows;
  const int threads = std::min(thread_count(settings.threads), blocks);
  const auto width = static_cast<std::size_t>(settings.width);
  std::atomic<std::uint32_t> ends = 0;
  std::atomic<bool> is_refused = false;
  OrderedBlocks queue(blocks, 4 * threads, ends);
  const std::stop_callback asked(control.stop, [&] {
    ends = 1;
    queue.wake();
  });
  run_on_threads(threads, [&] {
    try {
      while (const std::optional<int> number = queue.begin()) {
        const int first = *number * block_rows;
        BakedRows block{first, std::min(block_rows, all.rows - first), {}, {}};
        const std::size_t texels = static_cast<std::size_t>(block.rows) * width;
        block.planes.assign(all.planes.size(), std::vector<float>(texels));
        block.covered.resize(texels);
        copy_rows(all, first, block, 0, block.rows, settings.width);
        if (!queue.finish(*number, sink(block))) is_refused = true;
      }
      queue.wake();
    } catch (...) {
      ends = 1;
      queue.wake();
      throw;
    }
  });
  if (is_refused) return BakeResult::refused;
  return ends != 0 ? BakeResult::stopped : BakeResult::done;
}

}  // namespace

BakeResult bake_filled(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                       int block_rows, const RowSink& sink, const BakeControl& control,
                       BakeCounts* counts) {
  BakedRows all = whole(kernel, output, settings);
  const auto keep = [&](BakedRows& rows) -> std::function<bool()> {
    copy_rows(rows, 0, all, rows.first, rows.rows, settings.width);
    return [] { return true; };
  };
  const BakeResult result =
      bake(kernel, output, settings, rows_of_a_block(settings), keep, control, counts);
  if (result != BakeResult::done) return result;
  dilate(all.planes, all.covered, settings.width, settings.dilation);
  return hand_over(all, settings, block_rows, sink, control);
}

}  // namespace nacre::host
