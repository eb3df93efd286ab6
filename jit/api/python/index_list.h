#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>

#include "jit/api/python/array_view.h"

namespace nacre::python {

/// Numbers of elements that a caller hands in: a contiguous array of uint32, or of int32 that are
/// not negative. None gives an empty one.
class IndexList {
 public:
  /// Throws Error, which says `name`.
  IndexList(nanobind::handle object, const char* name);

  bool is_given() const { return is_given_; }
  std::uint64_t size() const { return size_; }
  /// Null where none is given.
  const std::uint32_t* data() const { return data_; }

 private:
  bool is_given_ = false;
  std::uint64_t size_ = 0;
  const std::uint32_t* data_ = nullptr;
  ArrayView view_;
};

}  // namespace nacre::python
