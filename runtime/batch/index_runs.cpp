#include "runtime/batch/index_runs.h"

#include <immintrin.h>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "runtime/batch/words.h"

namespace nacre {

namespace {

constexpr std::uint32_t width = 8;

bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}

/// How many indices lie before the one they follow, or eight or more behind it: as many runs end
/// at least. Without branches, which of a list that jumps about nobody predicts.
__attribute__((target("avx2"))) std::size_t count_jumps(const std::uint32_t* indices,
                                                        std::size_t count) {
  std::uint32_t jumps = 0;
  for (std::size_t i = 1; i < count; ++i) {
    jumps += indices[i] - indices[i - 1] - 1 < width - 1 ? 0u : 1u;
  }
  return jumps;
}

__attribute__((target("avx2"))) std::uint32_t largest_of(const std::uint32_t* indices,
                                                         std::size_t count) {
  std::uint32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, indices[i]);
  return largest;
}

}  // namespace

void IndexRuns::prepare(const std::uint32_t* indices, std::size_t count) {
  assert(count <= most);
  count_ = count;
  run_count_ = 0;
  std::copy_n(indices, count, indices_.begin());
  std::fill_n(indices_.begin() + static_cast<std::ptrdiff_t>(count), slack, 0u);
  if (!has_avx2() || count < width) return;
  // As many single loads as this cost what that many runs do, by measurement.
  const std::size_t worth_it = count * 2 / 5;
  if (count_jumps(indices, count) >= worth_it) return;
  // No run may read behind the last element that the list names.
  const std::uint32_t largest = largest_of(indices, count);
  if (largest + 1 < width) return;
  const std::uint32_t last_base = largest - (width - 1);
  for (std::size_t i = 0; i < count;) {
    if (run_count_ == worth_it) {
      run_count_ = 0;
      return;
    }
    const std::uint32_t base = std::min(indices[i], last_base);
    runs_[run_count_++] = {base, static_cast<std::uint32_t>(i)};
    for (++i; i < count && indices[i] > indices[i - 1] && indices[i] - base < width;) ++i;
  }
}

__attribute__((target("avx2"))) void IndexRuns::gather_runs(const std::uint32_t* from,
                                                            std::uint32_t* to) const {
  // The permutation looks at the low three bits of each index and so at those of the run;
  // what it makes of the others the next run overwrites.
  for (std::size_t k = 0; k < run_count_; ++k) {
    const Run run = runs_[k];
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + run.base));
    const __m256i indices =
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices_.data() + run.first));
    const __m256i places = _mm256_sub_epi32(indices, _mm256_set1_epi32(static_cast<int>(run.base)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + run.first),
                        _mm256_permutevar8x32_epi32(words, places));
  }
}

void IndexRuns::gather(const void* from, std::ptrdiff_t stride, std::uint32_t* to) const {
  if (stride == sizeof(std::uint32_t) && run_count_ != 0) {
    return gather_runs(static_cast<const std::uint32_t*>(from), to);
  }
  const auto* bytes = static_cast<const std::byte*>(from);
  if (stride == sizeof(std::uint32_t)) {
    return gather_words(count_, to,
                        [&](std::size_t i) { return bytes + 4 * std::size_t{indices_[i]}; });
  }
  gather_words(count_, to, [&](std::size_t i) {
    return bytes + stride * static_cast<std::ptrdiff_t>(indices_[i]);
  });
}

void IndexRuns::scatter(const std::uint32_t* from, void* to, std::ptrdiff_t stride) const {
  auto* bytes = static_cast<std::byte*>(to);
  if (stride == sizeof(std::uint32_t)) {
    return scatter_words(count_, from,
                         [&](std::size_t i) { return bytes + 4 * std::size_t{indices_[i]}; });
  }
  scatter_words(count_, from, [&](std::size_t i) {
    return bytes + stride * static_cast<std::ptrdiff_t>(indices_[i]);
  });
}

}  // namespace nacre
