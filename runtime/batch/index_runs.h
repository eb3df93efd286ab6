#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nacre {

/// Part of a list of indices, prepared to pick the elements of many arrays, and to put them back:
/// an ascending list falls into runs of elements that lie next to each other, and a run is a few
/// instructions where the CPU has AVX-512 (put back, within 16) or AVX2 (picked, within 8). AVX-512
/// picks by 16 places of the list instead, whose elements lie within 64 of the array. Any list
/// gives the right elements; one that jumps about takes a load and a store for each.
class IndexRuns {
 public:
  /// Indices of one part: what a kernel computes once a call is spread over as many points, and a
  /// column of the copies still is but a few kilobytes.
  static constexpr std::size_t most = 2048;
  /// Words behind the last that `gather` writes and `scatter` reads, too.
  static constexpr std::size_t slack = 16;

  /// What a CPU picks by.
  enum class Vectors : std::uint8_t { none, avx2, avx512 };
  /// The widest of this machine.
  static Vectors widest();

  /// `vectors`: no wider than widest().
  explicit IndexRuns(Vectors vectors = widest()) : vectors_(vectors) {}

  /// Prepares `count` indices, at most `most`.
  void prepare(const std::uint32_t* indices, std::size_t count);
  std::size_t count() const { return count_; }
  std::uint32_t operator[](std::size_t i) const { return indices_[i]; }

  /// An array of a host's, an element every `stride` bytes, and the copy of what the list picks of
  /// it: count() + slack words.
  struct Copy {
    std::byte* array;
    std::ptrdiff_t stride;
    std::uint32_t* words;
  };
  /// Copies that are best made together.
  static constexpr std::size_t together = 4;

  /// words[i] becomes the element of index i: at most `together` copies.
  void gather(std::span<const Copy> copies);
  /// The element of index i becomes words[i]; of equal indices the last one's.
  void scatter(std::span<const Copy> copies);

 private:
  /// Indices from `first` on, up to the next run's, are in [base, base + width).
  struct Run {
    std::uint32_t base;
    std::uint16_t first;
    std::uint16_t mask;  ///< AVX-512: bit k for base + k.
  };
  /// Places of the list that AVX-512 picks at once, and elements that theirs lie within.
  static constexpr std::size_t block = 16;
  static constexpr std::uint32_t window = 64;
  /// The base of a block whose elements lie further apart.
  static constexpr std::uint32_t no_window = ~std::uint32_t{0};

  /// When they are needed: who picks by blocks and puts nothing back needs none.
  void find_runs();
  void find_runs_avx2();
  void find_runs_avx512();
  void find_blocks();
  // By value: what is written could else be taken for a part of it.
  void gather_one(Copy copy) const;
  void gather_by_index(Copy copy, std::size_t first, std::size_t count) const;
  void gather_avx2(Copy copy) const;
  void scatter_one(Copy copy) const;
  /// Of columns, `stride` 4.
  /// @{
  template <std::size_t n>
  void gather_avx512(std::span<const Copy, n> copies) const;
  template <std::size_t n>
  void scatter_avx512(std::span<const Copy, n> copies) const;
  /// @}

  Vectors vectors_;
  std::array<std::uint32_t, most + slack> indices_;
  std::array<Run, most> runs_;
  std::array<std::uint32_t, most / block> windows_;  ///< Where each block's begins.
  std::size_t count_ = 0;
  std::size_t run_count_ = 0;     ///< 0: not worth it, or no vectors.
  std::size_t window_count_ = 0;  ///< Blocks that have one.
  bool has_looked_for_runs_ = false;
};

}  // namespace nacre
