#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace nacre {

/// Part of a list of indices, prepared to pick the elements of many arrays: an ascending list
/// falls into runs that lie within eight elements, and a run is one load, one permutation and
/// one store where the CPU has AVX2. Any list gives the right elements; one that jumps about
/// takes a load for each.
class IndexRuns {
 public:
  /// Indices of one part: what a kernel computes once a call is spread over as many points, and a
  /// column of the copies still is but a few kilobytes.
  static constexpr std::size_t most = 1024;
  static constexpr std::size_t slack = 8;  ///< Words behind the last that `gather` writes, too.

  /// Prepares `count` indices, at most `most`.
  void prepare(const std::uint32_t* indices, std::size_t count);
  std::size_t count() const { return count_; }
  std::uint32_t operator[](std::size_t i) const { return indices_[i]; }

  /// to[i] is the word at from + stride * index i, in bytes; room for count() + slack words.
  void gather(const void* from, std::ptrdiff_t stride, std::uint32_t* to) const;
  /// The word at to + stride * index i becomes from[i]; of equal indices the last one's.
  void scatter(const std::uint32_t* from, void* to, std::ptrdiff_t stride) const;

 private:
  /// Indices from `first` on, up to the next run's, are in [base, base + 8).
  struct Run {
    std::uint32_t base;
    std::uint32_t first;
  };
  void gather_runs(const std::uint32_t* from, std::uint32_t* to) const;

  std::array<std::uint32_t, most + slack> indices_;
  std::array<Run, most> runs_;
  std::size_t count_ = 0;
  std::size_t run_count_ = 0;  ///< 0: not worth it, or no AVX2.
};

}  // namespace nacre
