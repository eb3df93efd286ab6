#include "examples/common/run_on_threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace nacre::host {
namespace {

TEST(RunOnThreads, AsManyAsAskedForAndThisOneAmongThem) {
  for (const int threads : {1, 2, 7}) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    std::atomic<int> calls = 0;
    run_on_threads(threads, [&] {
      ++calls;
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(calls, threads);
    EXPECT_TRUE(seen.contains(std::this_thread::get_id()));
  }
}

TEST(RunOnThreads, WorkIsSharedWithoutGaps) {
  std::vector<std::atomic<int>> done(10'000);
  std::atomic<std::size_t> next = 0;
  run_on_threads(0, [&] {
    for (std::size_t i = next++; i < done.size(); i = next++) ++done[i];
  });
  for (const std::atomic<int>& one : done) EXPECT_EQ(one, 1);
}

TEST(RunOnThreads, AnExceptionOfAnyThreadComesHereOnceAllHaveEnded) {
  std::atomic<int> ended = 0;
  const auto work = [&] {
    struct End {
      std::atomic<int>& count;
      ~End() { ++count; }
    } end{ended};
    throw std::bad_alloc();
  };
  EXPECT_THROW(run_on_threads(4, work), std::bad_alloc);
  EXPECT_EQ(ended, 4);
}

}  // namespace
}  // namespace nacre::host
