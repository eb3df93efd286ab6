// Blocks that threads finish in any order are ended in theirs.
#include "examples/bake/ordered_blocks.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "examples/common/run_on_threads.h"

namespace nacre::host {
namespace {

constexpr int blocks = 200;

/// Takes longer for some blocks than for others.
void work(int block) {
  if (block % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
}

TEST(OrderedBlocksTest, EndInOrderWithinTheWindow) {
  for (const int threads : {1, 2, 5}) {
    std::atomic<std::uint32_t> ends = 0;
    OrderedBlocks queue(blocks, 3, ends);
    std::vector<int> ended;
    std::atomic<int> done = 0;
    std::atomic<int> furthest = 0;
    run_on_threads(threads, [&] {
      while (const auto block = queue.begin()) {
        int ahead = *block - done;
        for (int known = furthest;
             ahead > known && !furthest.compare_exchange_weak(known, ahead);) {
        }
        work(*block);
        EXPECT_TRUE(queue.finish(*block, [&ended, &done, number = *block] {
          ended.push_back(number);
          ++done;
          return true;
        }));
      }
    });
    std::vector<int> right(blocks);
    std::iota(right.begin(), right.end(), 0);
    EXPECT_EQ(ended, right) << threads;
    EXPECT_LE(furthest, 3);
    EXPECT_EQ(ends, 0u);
  }
}

TEST(OrderedBlocksTest, NothingComesAfterARefusal) {
  std::atomic<std::uint32_t> ends = 0;
  OrderedBlocks queue(blocks, 8, ends);
  std::atomic<int> last = -1;
  std::atomic<int> refused = 0;
  run_on_threads(4, [&] {
    while (const auto block = queue.begin()) {
      work(*block);
      const bool is_right = queue.finish(*block, [&last, number = *block] {
        last = number;
        return number != 50;
      });
      if (!is_right) ++refused;
    }
    queue.wake();
  });
  EXPECT_EQ(last, 50);
  EXPECT_EQ(refused, 1);
  EXPECT_EQ(ends, 1u);
}

TEST(OrderedBlocksTest, NobodyWaitsForOneThatThrew) {
  std::atomic<std::uint32_t> ends = 0;
  OrderedBlocks queue(blocks, 2, ends);
  EXPECT_THROW(run_on_threads(4,
                              [&] {
                                while (const auto block = queue.begin()) {
                                  queue.finish(*block, [number = *block]() -> bool {
                                    if (number == 20) throw std::runtime_error("full");
                                    return true;
                                  });
                                }
                                queue.wake();
                              }),
               std::runtime_error);
  EXPECT_EQ(ends, 1u);
}

}  // namespace
}  // namespace nacre::host
