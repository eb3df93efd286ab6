#include "runtime/batch/index_runs.h"

#include <immintrin.h>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "runtime/batch/words.h"

namespace nacre {

namespace {

/// Elements that a run of AVX2's may lie within, and one of AVX-512's.
constexpr std::uint32_t width_avx2 = 8, width_avx512 = 16;

/// As many single loads as this cost what that many runs do, by measurement.
std::size_t worth_it(std::size_t count) { return count * 2 / 5; }

bool is_column(const IndexRuns::Copy& copy) { return copy.stride == sizeof(std::uint32_t); }

/// Where copies are from and to, by value: what is written could else be taken for a part of it.
template <std::size_t n>
struct Ends {
  explicit Ends(std::span<const IndexRuns::Copy, n> copies) {
    for (std::size_t i = 0; i < n; ++i) {
      arrays[i] = reinterpret_cast<std::uint32_t*>(copies[i].array);
      words[i] = copies[i].words;
    }
  }
  std::array<std::uint32_t*, n> arrays, words;
};

/// Calls all_columns with those of the copies that are columns, as a span of fixed size, and
/// `other` with each that is none.
template <class Columns, class Other>
void sort_out(std::span<const IndexRuns::Copy> copies, Columns&& all_columns, Other&& other) {
  std::array<IndexRuns::Copy, IndexRuns::together> list;
  std::size_t count = 0;
  for (const IndexRuns::Copy& copy : copies) {
    is_column(copy) ? void(list[count++] = copy) : other(copy);
  }
  const std::span<const IndexRuns::Copy> columns(list);
  static_assert(IndexRuns::together == 4);
  switch (count) {
    case 1: return all_columns(columns.first<1>());
    case 2: return all_columns(columns.first<2>());
    case 3: return all_columns(columns.first<3>());
    case 4: return all_columns(columns.first<4>());
    default: assert(count == 0);
  }
}

/// How many indices lie before the one they follow, or `width` or more behind it: as many runs end
/// at least. Without branches, which of a list that jumps about nobody predicts.
__attribute__((target("avx2"))) std::size_t count_jumps(const std::uint32_t* indices,
                                                        std::size_t count, std::uint32_t width) {
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

IndexRuns::Vectors IndexRuns::widest() {
  static const Vectors found = [] {
    if (__builtin_cpu_supports("avx512f")) return Vectors::avx512;
    return __builtin_cpu_supports("avx2") ? Vectors::avx2 : Vectors::none;
  }();
  return found;
}

void IndexRuns::prepare(const std::uint32_t* indices, std::size_t count) {
  assert(count <= most);
  count_ = count;
  run_count_ = 0;
  window_count_ = 0;
  has_looked_for_runs_ = vectors_ == Vectors::none || count < width_avx2;
  std::copy_n(indices, count, indices_.begin());
  std::fill_n(indices_.begin() + static_cast<std::ptrdiff_t>(count), slack, 0u);
  if (vectors_ == Vectors::avx512) find_blocks();
}

void IndexRuns::find_runs() {
  if (has_looked_for_runs_) return;
  has_looked_for_runs_ = true;
  const bool is_wide = vectors_ == Vectors::avx512;
  const std::uint32_t width = is_wide ? width_avx512 : width_avx2;
  if (count_jumps(indices_.data(), count_, width) >= worth_it(count_)) return;
  is_wide ? find_runs_avx512() : find_runs_avx2();
  if (run_count_ >= worth_it(count_)) run_count_ = 0;
}

__attribute__((target("avx512f"))) void IndexRuns::find_blocks() {
  // No window may reach behind the last element that the list names.
  const std::uint32_t largest = largest_of(indices_.data(), count_);
  if (largest + 1 < window) return;
  const std::uint32_t last_base = largest - (window - 1);
  for (std::size_t i = 0; i < count_; i += block) {
    const auto valid =
        static_cast<__mmask16>(count_ - i < block ? (1u << (count_ - i)) - 1 : 0xffffu);
    // Where the first is the smallest, as in ascending lists.
    const std::uint32_t base = std::min(indices_[i], last_base);
    const __m512i places = _mm512_sub_epi32(_mm512_loadu_si512(indices_.data() + i),
                                            _mm512_set1_epi32(static_cast<int>(base)));
    const bool fits = _mm512_mask_cmpge_epu32_mask(valid, places, _mm512_set1_epi32(window)) == 0;
    windows_[i / block] = fits ? base : no_window;
    window_count_ += fits ? 1 : 0;
  }
}

void IndexRuns::find_runs_avx2() {
  // No run may read behind the last element that the list names.
  const std::uint32_t largest = largest_of(indices_.data(), count_);
  if (largest + 1 < width_avx2) return;
  const std::uint32_t last_base = largest - (width_avx2 - 1);
  for (std::size_t i = 0; i < count_;) {
    const std::uint32_t base = std::min(indices_[i], last_base);
    runs_[run_count_++] = {base, static_cast<std::uint16_t>(i), 0};
    for (++i; i < count_ && indices_[i] > indices_[i - 1] && indices_[i] - base < width_avx2;) ++i;
  }
}

/// x and, behind it, what comes before: by n places. (The plain intrinsics leave GCC 12 to warn of
/// their own undefined operands, as do those of "and not".)
template <int n>
__attribute__((target("avx512f"))) __m512i shifted_up(__m512i x, __m512i before) {
  return _mm512_maskz_alignr_epi32(0xffff, x, before, 16 - n);
}

/// Runs begin at multiples of the width, so that each index knows its own, and without branches:
/// where runs end nobody predicts. A run's mask is the sum of its bits: what the bits of all
/// indices up to its end add up to, less what those before it do.
__attribute__((target("avx512f"))) void IndexRuns::find_runs_avx512() {
  const __m512i low_bits = _mm512_set1_epi32(width_avx512 - 1);
  const __m512i high_bits = _mm512_set1_epi32(-static_cast<int>(width_avx512));
  const __m512i places = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i zero = _mm512_setzero_si512();
  std::uint32_t bases[most + slack], firsts[most + slack], sums[most + slack];
  std::size_t runs = 0;
  __m512i before = _mm512_set1_epi32(-1);  // In its last place the index that comes before.
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < count_; i += width_avx512) {
    const auto valid =
        static_cast<__mmask16>(count_ - i < width_avx512 ? (1u << (count_ - i)) - 1 : 0xffffu);
    const __m512i indices = _mm512_maskz_loadu_epi32(valid, indices_.data() + i);
    const __m512i last = shifted_up<1>(indices, before);
    const __m512i base = _mm512_and_si512(high_bits, indices);
    const __mmask16 begins =
        _mm512_mask_cmpneq_epu32_mask(valid, base, _mm512_and_si512(high_bits, last)) |
        _mm512_mask_cmple_epu32_mask(valid, indices, last) | (i == 0 ? 1 : 0);
    const __m512i bits =
        _mm512_maskz_sllv_epi32(valid, _mm512_set1_epi32(1), _mm512_and_si512(indices, low_bits));
    // Sums of all bits before each, by four steps.
    __m512i sums_before = shifted_up<1>(bits, zero);
    sums_before = _mm512_add_epi32(sums_before, shifted_up<1>(sums_before, zero));
    sums_before = _mm512_add_epi32(sums_before, shifted_up<2>(sums_before, zero));
    sums_before = _mm512_add_epi32(sums_before, shifted_up<4>(sums_before, zero));
    sums_before = _mm512_add_epi32(sums_before, shifted_up<8>(sums_before, zero));
    sums_before = _mm512_add_epi32(sums_before, _mm512_set1_epi32(static_cast<int>(sum)));
    const __m512i first = _mm512_add_epi32(places, _mm512_set1_epi32(static_cast<int>(i)));
    _mm512_storeu_si512(bases + runs, _mm512_maskz_compress_epi32(begins, base));
    _mm512_storeu_si512(firsts + runs, _mm512_maskz_compress_epi32(begins, first));
    _mm512_storeu_si512(sums + runs, _mm512_maskz_compress_epi32(begins, sums_before));
    runs += static_cast<std::size_t>(__builtin_popcount(begins));
    const __m512i last_sum =
        _mm512_maskz_compress_epi32(0x8000, _mm512_add_epi32(sums_before, bits));
    sum = static_cast<std::uint32_t>(_mm512_cvtsi512_si32(last_sum));
    before = indices;
  }
  sums[runs] = sum;
  for (std::size_t k = 0; k < runs; ++k) {
    runs_[k] = {bases[k], static_cast<std::uint16_t>(firsts[k]),
                static_cast<std::uint16_t>(sums[k + 1] - sums[k])};
  }
  run_count_ = runs;
}

__attribute__((target("avx2"))) void IndexRuns::gather_avx2(Copy copy) const {
  const auto* from = reinterpret_cast<const std::uint32_t*>(copy.array);
  // The permutation looks at the low three bits of each index and so at those of the run;
  // what it makes of the others the next run overwrites.
  for (std::size_t k = 0; k < run_count_; ++k) {
    const Run run = runs_[k];
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + run.base));
    const __m256i indices =
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices_.data() + run.first));
    const __m256i places = _mm256_sub_epi32(indices, _mm256_set1_epi32(static_cast<int>(run.base)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(copy.words + run.first),
                        _mm256_permutevar8x32_epi32(words, places));
  }
}

// Permutations, for to compress what a mask names takes a CPU (Zen 5) more than twice as long.
template <std::size_t n>
__attribute__((target("avx512f"))) void IndexRuns::gather_avx512(
    std::span<const Copy, n> copies) const {
  const Ends<n> ends(copies);
  for (std::size_t first = 0, count = count_; first < count; first += block) {
    const std::uint32_t base = windows_[first / block];
    if (base == no_window) {
      for (const Copy& copy : copies) {
        gather_by_index(copy, first, std::min(block, count - first));
      }
      continue;
    }
    const __m512i places = _mm512_sub_epi32(_mm512_loadu_si512(indices_.data() + first),
                                            _mm512_set1_epi32(static_cast<int>(base)));
    const __mmask16 is_high = _mm512_cmpge_epu32_mask(places, _mm512_set1_epi32(window / 2));
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t* const from = ends.arrays[i] + base;
      // Of a place the low five bits count: those within its half.
      const __m512i low = _mm512_permutex2var_epi32(_mm512_loadu_si512(from), places,
                                                    _mm512_loadu_si512(from + 16));
      const __m512i high = _mm512_permutex2var_epi32(_mm512_loadu_si512(from + 32), places,
                                                     _mm512_loadu_si512(from + 48));
      _mm512_storeu_si512(ends.words[i] + first, _mm512_mask_mov_epi32(low, is_high, high));
    }
  }
}

// What a mask leaves out is neither read nor written, wherever memory ends.
template <std::size_t n>
__attribute__((target("avx512f"))) void IndexRuns::scatter_avx512(
    std::span<const Copy, n> copies) const {
  const __m512i in_order = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const Ends<n> ends(copies);
  for (std::size_t k = 0, runs = run_count_; k < runs; ++k) {
    const Run run = runs_[k];
    const __m512i places = _mm512_maskz_expand_epi32(run.mask, in_order);
    for (std::size_t i = 0; i < n; ++i) {
      const __m512i words = _mm512_loadu_si512(ends.words[i] + run.first);
      _mm512_mask_storeu_epi32(ends.arrays[i] + run.base, run.mask,
                               _mm512_maskz_permutexvar_epi32(run.mask, places, words));
    }
  }
}

void IndexRuns::gather_by_index(Copy copy, std::size_t first, std::size_t count) const {
  const std::uint32_t* const indices = indices_.data() + first;
  gather_words(count, copy.words + first,
               [&](std::size_t i) { return copy.array + 4 * std::size_t{indices[i]}; });
}

void IndexRuns::gather_one(Copy copy) const {
  if (!is_column(copy)) {
    return gather_words(count_, copy.words, [&](std::size_t i) {
      return copy.array + copy.stride * static_cast<std::ptrdiff_t>(indices_[i]);
    });
  }
  if (vectors_ == Vectors::avx2 && run_count_ != 0) return gather_avx2(copy);
  gather_by_index(copy, 0, count_);
}

void IndexRuns::scatter_one(Copy copy) const {
  if (!is_column(copy)) {
    return scatter_words(count_, copy.words, [&](std::size_t i) {
      return copy.array + copy.stride * static_cast<std::ptrdiff_t>(indices_[i]);
    });
  }
  scatter_words(count_, copy.words,
                [&](std::size_t i) { return copy.array + 4 * std::size_t{indices_[i]}; });
}

void IndexRuns::gather(std::span<const Copy> copies) {
  if (vectors_ == Vectors::avx2) find_runs();
  const auto one = [this](const Copy& copy) { gather_one(copy); };
  if (window_count_ == 0) return void(std::ranges::for_each(copies, one));
  sort_out(copies, [this](auto columns) { gather_avx512(columns); }, one);
}

void IndexRuns::scatter(std::span<const Copy> copies) {
  if (vectors_ == Vectors::avx512) find_runs();
  const auto one = [this](const Copy& copy) { scatter_one(copy); };
  if (vectors_ != Vectors::avx512 || run_count_ == 0) {
    return void(std::ranges::for_each(copies, one));
  }
  sort_out(copies, [this](auto columns) { scatter_avx512(columns); }, one);
}

}  // namespace nacre
