#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nacre {

/// Which element of a host's array belongs to the i-th point that is shaded.
enum class ElementOf : std::uint8_t {
  point,     ///< Element points[i] of Batch::points; i where there is no list.
  place,     ///< Element i: arrays that are as long as the list.
  instance,  ///< Element instances[points[i]], or instances[i] without a list.
};

/// How a host keeps the numbers of one channel: four bytes each, float, int32 or a boolean as
/// int32 0 or 1.
struct ChannelLayout {
  std::uint32_t array = 0;    ///< Which of Batch::arrays.
  std::ptrdiff_t offset = 0;  ///< Bytes from there to element 0.
  std::ptrdiff_t stride = 4;  ///< Bytes from one element to the next; 0: one for all points.
  ElementOf element = ElementOf::point;  ///< Which element is a point's.

  bool operator==(const ChannelLayout&) const = default;
};

/// Points to be shaded, of arrays whose layouts a Binding knows.
struct Batch {
  std::span<void* const> arrays;  ///< Where the host's arrays begin.
  std::uint64_t count = 0;        ///< Points to shade.
  /// Which points, `count` of them; null: the first `count`. In ascending order they are
  /// picked fastest. A point that is named twice is shaded twice.
  const std::uint32_t* points = nullptr;
  /// For every point of the arrays, the element of what is bound as ElementOf::instance.
  const std::uint32_t* instances = nullptr;
  /// As KernelArguments::stop.
  const std::atomic<std::uint32_t>* stop = nullptr;
};

}  // namespace nacre
