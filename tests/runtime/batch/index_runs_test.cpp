#include "runtime/batch/index_runs.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <vector>

namespace nacre {
namespace {

/// Words that end where memory ends: a read behind them is a fault.
class WordsBeforeNothing {
 public:
  explicit WordsBeforeNothing(std::size_t count) : count_(count) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    bytes_ = (count * 4 + page - 1) / page * page;
    memory_ =
        mmap(nullptr, bytes_ + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mprotect(static_cast<std::byte*>(memory_) + bytes_, page, PROT_NONE);
    page_ = page;
    for (std::size_t i = 0; i < count; ++i) {
      const auto word = static_cast<std::uint32_t>(i * 2654435761u);
      std::memcpy(data() + i, &word, 4);
    }
  }
  WordsBeforeNothing(const WordsBeforeNothing&) = delete;
  WordsBeforeNothing& operator=(const WordsBeforeNothing&) = delete;
  ~WordsBeforeNothing() { munmap(memory_, bytes_ + page_); }

  std::uint32_t* data() const {
    return reinterpret_cast<std::uint32_t*>(static_cast<std::byte*>(memory_) + bytes_) - count_;
  }

 private:
  std::size_t count_;
  std::size_t bytes_ = 0;
  std::size_t page_ = 0;
  void* memory_ = nullptr;
};

/// Those of this machine.
std::vector<IndexRuns::Vectors> all_vectors() {
  std::vector<IndexRuns::Vectors> all;
  for (const auto each :
       {IndexRuns::Vectors::none, IndexRuns::Vectors::avx2, IndexRuns::Vectors::avx512}) {
    if (each <= IndexRuns::widest()) all.push_back(each);
  }
  return all;
}

IndexRuns::Copy column(std::uint32_t* array, std::vector<std::uint32_t>& words) {
  return {reinterpret_cast<std::byte*>(array), 4, words.data()};
}

void expect_picked(std::span<const std::uint32_t> list, std::uint32_t* words) {
  for (const IndexRuns::Vectors vectors : all_vectors()) {
    IndexRuns runs(vectors);
    runs.prepare(list.data(), list.size());
    for (std::size_t copies = 1; copies <= IndexRuns::together; ++copies) {
      std::vector<std::vector<std::uint32_t>> picked(
          copies, std::vector<std::uint32_t>(list.size() + IndexRuns::slack));
      std::vector<IndexRuns::Copy> all;
      for (std::vector<std::uint32_t>& each : picked) all.push_back(column(words, each));
      runs.gather(all);
      for (std::size_t i = 0; i < list.size(); ++i) {
        ASSERT_EQ(picked[0][i], words[list[i]]) << i << " of " << list.size();
        for (const auto& each : picked) ASSERT_EQ(each[i], picked[0][i]);
      }
    }
  }
}

/// Against one store after another; nothing else of the array changes, nor is anything behind it
/// touched.
void expect_put(std::span<const std::uint32_t> list, std::size_t size) {
  std::vector<std::uint32_t> given(list.size() + IndexRuns::slack);
  for (std::size_t i = 0; i < given.size(); ++i) given[i] = static_cast<std::uint32_t>(i + 1);
  std::vector<std::uint32_t> expected(size, 0);
  for (std::size_t i = 0; i < list.size(); ++i) expected[list[i]] = given[i];
  for (const IndexRuns::Vectors vectors : all_vectors()) {
    IndexRuns runs(vectors);
    runs.prepare(list.data(), list.size());
    for (std::size_t copies = 1; copies <= IndexRuns::together; ++copies) {
      std::vector<std::unique_ptr<WordsBeforeNothing>> arrays;
      std::vector<IndexRuns::Copy> all;
      for (std::size_t k = 0; k < copies; ++k) {
        arrays.push_back(std::make_unique<WordsBeforeNothing>(size));
        std::fill_n(arrays[k]->data(), size, 0u);
        all.push_back(column(arrays[k]->data(), given));
      }
      runs.scatter(all);
      for (const auto& array : arrays) {
        ASSERT_TRUE(std::equal(expected.begin(), expected.end(), array->data()));
      }
    }
  }
}

// Every density, each list ending with the last element there is.
TEST(IndexRuns, PickWhatTheListNamesAndReadNothingBehindIt) {
  const WordsBeforeNothing words(1500);
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round) {
    const double density = (round % 20 + 1) / 20.0;
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 1499; list.size() < 1 + random() % IndexRuns::most; --i) {
      if (i == 1499 || std::bernoulli_distribution(density)(random)) list.insert(list.begin(), i);
      if (i == 0) break;
    }
    expect_picked(list, words.data());
    expect_put(list, 1500);
  }
}

TEST(IndexRuns, TakeListsInAnyOrder) {
  const WordsBeforeNothing words(1500);
  std::mt19937 random(2);
  for (int round = 0; round < 100; ++round) {
    std::vector<std::uint32_t> list(random() % IndexRuns::most + 1);
    for (std::uint32_t& index : list)
      index = static_cast<std::uint32_t>(random() % (round % 2 == 0 ? 1500 : 9));
    expect_picked(list, words.data());
    expect_put(list, 1500);
    // Few jumps, and an index again and again: the last counts.
    std::ranges::sort(list);
    expect_picked(list, words.data());
    expect_put(list, 1500);
  }
}

TEST(IndexRuns, OfShortArraysReadNothingBehindThem) {
  for (std::size_t count = 1; count < 20; ++count) {
    const WordsBeforeNothing words(count);
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < count; ++i) all.push_back(i);
    expect_picked(all, words.data());
    expect_picked(std::span(all).last(1), words.data());
    const std::vector<std::uint32_t> often(12, static_cast<std::uint32_t>(count - 1));
    expect_picked(often, words.data());
  }
}

// Columns and what is none in one call, at every count of either.
TEST(IndexRuns, PickAndPutColumnsBesideStructures) {
  const WordsBeforeNothing words(3000);
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < 999; i += 1 + i % 3) list.push_back(i);
  for (const IndexRuns::Vectors vectors : all_vectors()) {
    for (unsigned kinds = 0; kinds < 16; ++kinds) {
      IndexRuns runs(vectors);
      runs.prepare(list.data(), list.size());
      std::vector<std::vector<std::uint32_t>> picked(
          4, std::vector<std::uint32_t>(list.size() + IndexRuns::slack));
      std::vector<std::uint32_t> put(3000, 1);
      std::vector<IndexRuns::Copy> from, to;
      for (unsigned k = 0; k < 4; ++k) {
        const std::ptrdiff_t stride = (kinds >> k & 1) != 0 ? 12 : 4;
        const auto bytes = [](std::uint32_t* word) { return reinterpret_cast<std::byte*>(word); };
        from.push_back({bytes(words.data()), stride, picked[k].data()});
        to.push_back({bytes(put.data()), stride, picked[k].data()});
      }
      runs.gather(from);
      std::vector<std::uint32_t> expected(3000, 1);
      for (unsigned k = 0; k < 4; ++k) {
        const std::size_t apart = (kinds >> k & 1) != 0 ? 3 : 1;
        for (std::size_t i = 0; i < list.size(); ++i) {
          ASSERT_EQ(picked[k][i], words.data()[apart * list[i]]) << kinds << ' ' << k;
          expected[apart * list[i]] = words.data()[apart * list[i]];
        }
      }
      runs.scatter(to);
      ASSERT_EQ(put, expected) << kinds;
    }
  }
}

TEST(IndexRuns, PickAndPutAtAnyStride) {
  const std::vector<std::uint32_t> list{3, 0, 2, 9};
  IndexRuns runs;
  runs.prepare(list.data(), list.size());
  std::vector<std::uint32_t> table(30);
  for (std::uint32_t i = 0; i < 30; ++i) table[i] = i;
  std::vector<std::uint32_t> picked(list.size() + IndexRuns::slack);
  const IndexRuns::Copy from{reinterpret_cast<std::byte*>(table.data() + 1), 12, picked.data()};
  runs.gather({&from, 1});
  EXPECT_EQ(std::vector(picked.begin(), picked.begin() + 4),
            (std::vector<std::uint32_t>{10, 1, 7, 28}));
  std::vector<std::uint32_t> out(20, 7);
  const IndexRuns::Copy to{reinterpret_cast<std::byte*>(out.data()), 8, picked.data()};
  runs.scatter({&to, 1});
  std::vector<std::uint32_t> expected(20, 7);
  expected[6] = 10, expected[0] = 1, expected[4] = 7, expected[18] = 28;
  EXPECT_EQ(out, expected);
}

}  // namespace
}  // namespace nacre
