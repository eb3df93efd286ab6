#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "jit/api/python/placement.h"

namespace nacre::python {

/// Ends runs from another thread; see nacre_batch::stop.
class Stop {
 public:
  void set() { flag_ = 1; }
  void clear() { flag_ = 0; }
  bool is_set() const { return flag_ != 0; }
  const volatile std::uint32_t* flag() const {
    return reinterpret_cast<const volatile std::uint32_t*>(&flag_);
  }

 private:
  std::atomic<std::uint32_t> flag_{0};
  static_assert(sizeof flag_ == sizeof(std::uint32_t));
};

/// A name, what has its numbers, and NACRE_OF_POINT or another.
struct NamedArray {
  std::string name;
  nanobind::object object;
  int element = NACRE_OF_POINT;
};

/// What one call asks; see nacre_batch.
struct Request {
  std::uint64_t count = 0;
  const std::uint32_t* points = nullptr;  ///< `count` of them, or null.
  const std::uint32_t* instances = nullptr;
  std::uint64_t instance_count = 0;
  const nacre_instance* instance = nullptr;
  const volatile std::uint32_t* stop = nullptr;
  std::uint32_t point = 0;
};

/// A shader's kernels on arrays of Python's, which live as long as this does. Every run is checked
/// against their lengths: nothing outside them is read or written.
class BoundArrays {
 public:
  /// Of the entries in `entries`, bits 1 << nacre_entry; 0: all that there are. Throws Error.
  BoundArrays(const Shader& shader, const std::vector<NamedArray>& arrays, std::uint32_t entries);

  /// Elements of the shortest array that the entry has for its points; Placement::endless where
  /// all are constants.
  std::uint64_t count(nacre_entry entry) const;
  /// Elements of the shortest array of all that belong to points, whether an entry reads it or not:
  /// what is constant has to be stored as often as there are points.
  std::uint64_t length() const;
  /// Throws Error where an array is too short. Does not need the GIL.
  void check(nacre_entry entry, const Request& request) const;
  /// False where it was stopped. Lets other threads of Python run; throws what a signal's handler
  /// raises, which is looked for every `interval` points.
  bool run(nacre_entry entry, const Request& request) const;

  static constexpr std::uint64_t interval = 1 << 16;

 private:
  /// How an entry takes elements of an array.
  struct Use {
    std::size_t array = 0;
    bool is_of_one_point = false;  ///< NACRE_EVALUATE_AT's, but for directions and results.
  };

  void find_uses(const Shader& shader, nacre_entry entry);
  /// Elements that a use needs of an array: past the greatest one.
  std::uint64_t needed(const Use& use, const Request& request, std::uint64_t past_points,
                       std::uint64_t past_instances) const;

  std::vector<Placement> placements_;
  std::array<std::vector<Use>, NACRE_ENTRY_COUNT> uses_;
  std::uint32_t missing_ = 0;  ///< Entries that the shader has and that were not asked for.
  nacre::detail::Owned<nacre_binding, nacre_binding_destroy> binding_;
};

}  // namespace nacre::python
