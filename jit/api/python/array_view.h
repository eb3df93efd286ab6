#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nacre::python {

/// The memory of a Python object, by the buffer protocol or else by DLPack: nothing is copied, and
/// the object lives as long as the view. Made and destroyed with the GIL.
struct ArrayView {
  std::byte* data = nullptr;  ///< Of element 0, wherever strides lead from there.
  std::string type;    ///< "float32", "uint8"; as the exporter says where it is none of ours.
  std::string device;  ///< "cpu", or what DLPack calls it.
  bool is_read_only = false;
  std::vector<std::ptrdiff_t> shape;
  std::vector<std::ptrdiff_t> strides;  ///< Bytes from one element to the next, along each axis.
  std::shared_ptr<void> holder;

  /// Nothing for what is no array.
  static std::optional<ArrayView> of(nanobind::handle object);
  /// "float32 (1024, 3)"
  std::string text() const;
};

/// "(1024, 3)"
std::string shape_text(const std::vector<std::ptrdiff_t>& shape);

}  // namespace nacre::python
