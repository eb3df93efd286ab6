#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "jit/api/python/channel_use.h"

namespace nacre::python {

/// Where an array has the elements of points.
struct Placement {
  static constexpr std::uint64_t endless = std::numeric_limits<std::uint64_t>::max();

  std::string name;
  int element = NACRE_OF_POINT;
  std::byte* data = nullptr;
  std::ptrdiff_t stride = 0;       ///< Bytes from one element to the next.
  std::uint64_t length = endless;  ///< Elements; endless: one for all points.
  std::shared_ptr<void> holder;    ///< Keeps the memory.
};

/// Binds the channels of `name` to an object: numbers are constants, which are copied; arrays are
/// referred to by `placements`, as the one of the next number. Throws Error for what does not fit.
void place(nacre_binder* binder, std::vector<Placement>& placements, const std::string& name,
           int element, const ChannelUse& use, nanobind::handle object);

}  // namespace nacre::python
